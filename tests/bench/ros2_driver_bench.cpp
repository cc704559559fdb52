/// From a robot's control tick to a reader on Fast DDS in another process, through `astrolabe ros2`: how long, and what it costs.
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/cdr/type_description.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/live/dds/fast_dds.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/ros2/domain.hpp"

namespace {

using namespace astro;
using namespace astro::ros2;
using std::chrono::duration;
using std::chrono::microseconds;
using std::chrono::steady_clock;

/// Processor time of a process that has ended, and of all that ended before it.
double children_cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double age_us(const msg::Odometry& odometry) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return 1e-3 *
         static_cast<double>(std::chrono::nanoseconds(now).count() - msg::nanoseconds(odometry.header.stamp));
}

/// Stamps are the robot's, so what this prints contains the link, and the error of its clock's map: half a round trip.
bool measure(int rate_Hz, int seconds) {
  const int domain = support::test_domain();
  support::Simulator robot({"--slip", "0"});
  const auto participant = dds::open_fast_dds({domain}, "reader", "");
  const auto reader =
      participant->create_reader({"rt/odom", dds_type_name(msg::Odometry::kType), {.depth = 1000}});
  const double cpu_before_s = children_cpu_s();
  const auto start = steady_clock::now();
  support::Program node({ASTROLABE_PROGRAM, "ros2", "--port", robot.port(), "--rate", std::to_string(rate_Hz),
                         "--domain", std::to_string(domain)});
  std::vector<double> ages_us;
  const auto wanted = static_cast<std::size_t>(rate_Hz * seconds);
  std::size_t skipped = 0;  // while both find each other, and the clock's map settles
  while (ages_us.size() < wanted && steady_clock::now() - start < std::chrono::seconds(60 + seconds)) {
    participant->wait(microseconds(100'000));
    for (const dds::Sample& sample : reader->take())
      if (const auto message = decode<msg::Odometry>(sample.payload))
        if (++skipped > static_cast<std::size_t>(rate_Hz)) ages_us.push_back(age_us(*message));
  }
  node.send(SIGINT);
  node.wait();
  const double wall_s = duration<double>(steady_clock::now() - start).count();
  const double share = (children_cpu_s() - cpu_before_s) / wall_s;
  if (ages_us.empty()) return false;
  std::sort(ages_us.begin(), ages_us.end());
  const auto part = [&](double of) {
    return ages_us[static_cast<std::size_t>(of * static_cast<double>(ages_us.size() - 1))];
  };
  fmt::print(
      "{:4} Hz: tick to reader p50 {:5.0f} us, p99 {:6.0f} us, {} samples of {}; astrolabe ros2 takes {:.1f} "
      "% of a processor\n",
      rate_Hz, part(0.5), part(0.99), ages_us.size(), wanted, 100 * share);
  return true;
}

}  // namespace

int main(int count, char** arguments) {
  const int seconds = count > 1 ? std::atoi(arguments[1]) : 10;
  bool good = true;
  for (const int rate_Hz : {100, 1000}) good = measure(rate_Hz, seconds) && good;
  return good ? 0 : 1;
}
