/// From publish() of a node to a reader on Fast DDS in another process: how long, and what it costs the node.
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/live/dds/fast_dds.hpp"
#include "host/live/ros2/node.hpp"
#include "tests/support/ros2/domain.hpp"

namespace {

using namespace astro;
using namespace astro::live;
using namespace astro::ros2;
using std::chrono::microseconds;
using std::chrono::steady_clock;

constexpr auto kLongest = std::chrono::seconds(60);

/// One clock for all processes of this computer.
std::int64_t now_ns() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kNanosPerSecond + time.tv_nsec;
}

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// What the child does: reads until nothing has come for a while, then prints.
int read(int domain, double rate_Hz) {
  const auto participant = dds::open_fast_dds({domain}, "reader", "");
  const auto reader =
      participant->create_reader({"rt/odom", dds_type_name(msg::Odometry::kType), {.depth = 1000}});
  std::vector<double> latencies_us;
  auto last = steady_clock::now();
  while (steady_clock::now() - last < std::chrono::seconds(latencies_us.empty() ? 10 : 1)) {
    participant->wait(microseconds(100'000));
    for (const dds::Sample& sample : reader->take()) {
      last = steady_clock::now();
      if (const auto message = decode<msg::Odometry>(sample.payload))
        latencies_us.push_back(1e-3 *
                               static_cast<double>(now_ns() - msg::nanoseconds(message->header.stamp)));
    }
  }
  if (latencies_us.empty()) return 1;
  std::sort(latencies_us.begin(), latencies_us.end());
  const auto part = [&](double share) {
    return latencies_us[static_cast<std::size_t>(share * static_cast<double>(latencies_us.size() - 1))];
  };
  fmt::print("{:4.0f} Hz: p50 {:4.0f} us, p99 {:5.0f} us, longest {:6.0f} us, {} samples", rate_Hz, part(0.5),
             part(0.99), part(1), latencies_us.size());
  std::fflush(stdout);
  return 0;
}

bool measure(double rate_Hz, int samples) {
  const int domain = support::test_domain();
  const pid_t child = fork();  // before there are threads
  if (child == 0) _exit(read(domain, rate_Hz));
  const auto node = open_node({{"robot"}, GidSize::iron_and_later}, {domain});
  const auto odom = node->advertise({"/odom", message_type<msg::Odometry>()});
  node->poll();
  const auto begin = steady_clock::now();
  while (!odom->has_subscribers() && steady_clock::now() - begin < kLongest) node->wait(microseconds(1000));
  node->wait(std::chrono::seconds(1));  // both ends have found each other
  const double cpu_before_s = cpu_s();
  const auto start = steady_clock::now();
  const std::chrono::duration<double> period(1 / rate_Hz);
  for (int i = 0; i < samples; ++i) {
    msg::Odometry message;
    message.header = {msg::to_time(now_ns()), "odom"};
    message.child_frame_id = "base_link";
    odom->publish(encode(message), 0);
    node->poll();
    const auto next = start + std::chrono::duration_cast<steady_clock::duration>((i + 1) * period);
    for (auto left = next - steady_clock::now(); left.count() > 0; left = next - steady_clock::now())
      node->wait(std::chrono::ceil<microseconds>(left));
  }
  const double wall_s = std::chrono::duration<double>(steady_clock::now() - start).count();
  const double share = (cpu_s() - cpu_before_s) / wall_s;
  int status = 0;
  waitpid(child, &status, 0);
  fmt::print(" of {}; the node takes {:.1f} % of a processor\n", samples, 100 * share);
  std::fflush(stdout);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

int main(int count, char** arguments) {
  const int seconds = count > 1 ? std::atoi(arguments[1]) : 10;
  bool good = true;
  for (const int rate_Hz : {100, 1000}) {
    std::fflush(stdout);
    const pid_t child = fork();  // each rate in a process without threads of the other
    if (child == 0) {
      const bool came = measure(rate_Hz, rate_Hz * seconds);
      _exit(came ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    good = good && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  return good ? 0 : 1;
}
