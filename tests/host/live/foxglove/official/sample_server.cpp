// Serves a robot that does not exist until its standard input ends; prints the port. What it publishes follows from the number of
// the message, so that check.mjs knows each value.
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/nodes.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/formats/messages/std.hpp"
#include "host/live/foxglove/foxglove_server.hpp"

namespace {

using namespace astro;        // NOLINT(google-build-using-namespace): a program for one test
using namespace astro::ros2;  // NOLINT(google-build-using-namespace)
using namespace astro::live;  // NOLINT(google-build-using-namespace)

/// c_R, a real number up to 2.
class Table : public ParameterTable {
 public:
  std::vector<msg::ParameterDescriptor> descriptors() override {
    return {{"c_R", static_cast<std::uint8_t>(ParameterType::real), "", "", false, false, {}, {}}};
  }
  std::optional<msg::ParameterValue> value(std::string_view name) override {
    if (name != "c_R") return std::nullopt;
    msg::ParameterValue value;
    value.type = static_cast<std::uint8_t>(ParameterType::real);
    value.double_value = c_r_;
    return value;
  }
  msg::SetParametersResult set(std::span<const msg::Parameter> parameters) override {
    for (const msg::Parameter& each : parameters) {
      if (each.name != "c_R" || !(each.value.double_value < 2)) return {false, each.name + " cannot be this"};
      c_r_ = each.value.double_value;
    }
    return {true, ""};
  }

 private:
  double c_r_ = 1;
};

/// Publishes M under a name.
template <Message M>
class Topic {
 public:
  Topic(Middleware& middleware, const std::string& name, bool latched = false) {
    TopicDescription topic{name, message_type<M>()};
    topic.latched = latched;
    topic.depth = 1;
    publisher_ = middleware.advertise(topic);
  }
  void say(const M& message, std::int64_t time_ns) { publisher_->publish(encode(message), time_ns); }

 private:
  std::unique_ptr<Publisher> publisher_;
};

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr std::int64_t kAhead = 400;  // 1.6 MB, less than half of what the server keeps for a viewer

class Robot {
 public:
  explicit Robot(Middleware& middleware)
      : odom_(middleware, "/odom"),
        joints_(middleware, "/joint_states"),
        battery_(middleware, "/battery_state"),
        diagnostics_(middleware, "/diagnostics"),
        flood_(middleware, "/flood"),
        echo_(middleware, "/echo"),
        model_(middleware, "/robot_description", true) {
    model_.say({"<robot name='none'/>"}, 0);
    middleware.subscribe({"/cmd_vel", message_type<msg::Twist>()}, [this](ByteView bytes) {
      if (const auto twist = decode<msg::Twist>(bytes)) echo_.say(*twist, 0);
    });
    middleware.subscribe({"/heard", message_type<msg::String>()}, [this](ByteView bytes) {
      if (const auto number = decode<msg::String>(bytes))
        heard_ = std::strtoll(number->data.c_str(), nullptr, 10);
    });
    middleware.serve({"/emergency_stop", msg::Trigger::kType, message_type<msg::Trigger::Request>(),
                      message_type<msg::Trigger::Response>()},
                     [](ByteView) {
                       return encode(msg::Trigger::Response{true, "stopped"});
                     });
    middleware.serve_parameters(table_);
  }

  /// The last message that a viewer said to have heard; 0 if none has.
  std::int64_t heard() const { return heard_; }

  void step(std::int64_t number) {
    const std::int64_t now = number * kPeriod_ns;
    const msg::Header header{
        {static_cast<std::int32_t>(now / 1'000'000'000), static_cast<std::uint32_t>(now % 1'000'000'000)},
        "odom"};
    const auto n = static_cast<double>(number);
    msg::Odometry odometry{header, "base_footprint", {}, {}};
    odometry.pose.pose.position.x = n / 1024;
    odometry.twist.twist.angular.z = -n;
    odom_.say(odometry, now);
    flood_.say({std::to_string(number) + std::string(4'000, '.')}, now);
    if (number % 10 != 0) return;
    joints_.say({header, {"left", "right"}, {n, -n}, {1, 2}, {}}, now);
    msg::BatteryState battery{};
    battery.header = header;
    battery.voltage = static_cast<float>(number % 1000);
    battery_.say(battery, now);
    diagnostics_.say({header, {{std::byte{1}, "link", "slow", "robot", {{"age", std::to_string(number)}}}}},
                     now);
  }

 private:
  Table table_;
  Topic<msg::Odometry> odom_;
  Topic<msg::JointState> joints_;
  Topic<msg::BatteryState> battery_;
  Topic<msg::DiagnosticArray> diagnostics_;
  Topic<msg::String> flood_;
  Topic<msg::Twist> echo_;
  Topic<msg::String> model_;
  std::int64_t heard_ = 0;
};

bool stdin_has_ended() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  char byte = 0;
  return ::poll(&input, 1, 0) > 0 && ::read(STDIN_FILENO, &byte, 1) <= 0;
}

}  // namespace

int main() {
  foxglove::Settings settings;
  settings.name = "sample";
  settings.address.port = 0;
  settings.allow_commands = true;
  foxglove::FoxgloveServer server(std::move(settings));
  Robot robot(server);
  server.poll();
  std::printf("%d\n", server.port());
  std::fflush(stdout);
  for (std::int64_t number = 1; !stdin_has_ended();) {
    server.poll();
    // No faster than the viewer that says what it has heard; few until one does.
    if (robot.heard() > 0 && number - robot.heard() > kAhead) {
      server.wait(std::chrono::milliseconds(1));
      continue;
    }
    if (robot.heard() == 0) server.wait(std::chrono::milliseconds(20));
    robot.step(number++);
  }
}
