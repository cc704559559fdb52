// What it costs to show a robot in Foxglove: 20 topics at 1 kHz to one viewer, for 60 s or as many seconds as the argument says.
// Bar: 10 % of a core, for publishing and serving together, and nothing lost. The viewer is a process of its own.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/live/foxglove/foxglove_server.hpp"
#include "tests/host/live/foxglove/viewer.hpp"

namespace {

using namespace astro;        // NOLINT(google-build-using-namespace): a program
using namespace astro::ros2;  // NOLINT(google-build-using-namespace)
using namespace astro::live;  // NOLINT(google-build-using-namespace)
using std::chrono::steady_clock;

constexpr int kTopics = 20, kRate_hz = 1000;

/// Counts what comes until `expected` messages have come or nothing does for three seconds; the exit code says whether all came.
[[noreturn]] void watch(std::uint16_t port, std::int64_t expected) {
  support::Viewer viewer(port);
  nlohmann::json subscriptions;
  for (int i = 1; i <= kTopics; ++i) subscriptions.push_back({{"id", i}, {"channelId", i}});
  viewer.send(nlohmann::json{{"op", "subscribe"}, {"subscriptions", subscriptions}}.dump());
  std::int64_t count = 0;
  while (count < expected) {
    const auto message = viewer.receive(std::chrono::seconds(3));
    if (!message) break;
    if (!message->is_text) ++count;
  }
  fmt::print("  received {} of {} messages\n", count, expected);
  std::fflush(stdout);
  _exit(count == expected ? 0 : 1);
}

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

foxglove::Settings settings() {
  foxglove::Settings settings;
  settings.name = "bench";
  settings.address.port = 0;
  return settings;
}

std::vector<std::unique_ptr<Publisher>> advertise(Middleware& server) {
  std::vector<std::unique_ptr<Publisher>> topics;
  for (int i = 0; i < kTopics; ++i)
    topics.push_back(server.advertise({fmt::format("/signal_{}", i), message_type<msg::TwistStamped>()}));
  return topics;
}

void publish(const std::vector<std::unique_ptr<Publisher>>& topics, double value) {
  for (const auto& topic : topics) {
    msg::TwistStamped message;
    message.header.frame_id = "base_link";
    message.twist.linear.x = value;
    topic->publish(encode(message), static_cast<std::int64_t>(value * 1e6));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 60;
  const auto turns = static_cast<std::int64_t>(seconds * kRate_hz);
  foxglove::FoxgloveServer server(settings());
  const auto topics = advertise(server);
  const pid_t viewer = fork();  // before the server's thread starts
  if (viewer == 0) watch(server.port(), turns * kTopics);
  while (!topics.back()->has_subscribers()) {
    server.poll();
    server.wait(std::chrono::milliseconds(10));
  }
  const double cpu_before_s = cpu_s();
  const auto begin = steady_clock::now();
  for (std::int64_t turn = 1; turn <= turns; ++turn) {
    publish(topics, static_cast<double>(turn));
    server.poll();
    const auto next = begin + turn * std::chrono::microseconds(1'000'000 / kRate_hz);
    server.wait(std::chrono::duration_cast<std::chrono::microseconds>(next - steady_clock::now()));
  }
  const double took_s = std::chrono::duration<double>(steady_clock::now() - begin).count();
  const double share = (cpu_s() - cpu_before_s) / took_s;
  int status = 0;
  waitpid(viewer, &status, 0);
  fmt::print("foxglove: {} topics at {} Hz for {:.1f} s: {:.1f} % of a core (bar 10 %), lost: {}\n", kTopics,
             kRate_hz, took_s, 100 * share, status == 0 ? "none" : "SOME");
}
