#pragma once

#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/std.hpp"
#include "host/live/ros2/node.hpp"

namespace astro::support {

/// A node with as many endpoints as a robot's, and no robot: it repeats one message on its topics, and each reply of a service says
/// how often it has been called.
class RobotNode {
 public:
  static constexpr std::array kTopics{"/odom", "/a", "/b", "/c", "/d", "/e"};  // all are odometry
  static constexpr std::array kServices{"/stop", "/s", "/t", "/u", "/v", "/w", "/x", "/y"};

  explicit RobotNode(const dds::Discovery& discovery)
      : node_(live::open_node({{"robot"}, live::GidSize::iron_and_later}, discovery)) {
    using namespace ros2;
    using live::message_type;
    for (const char* topic : kTopics)
      publishers_.push_back(node_->advertise({topic, message_type<msg::Odometry>()}));
    node_->subscribe({"/cmd_vel", message_type<msg::Twist>(), false}, [](ByteView) {});
    node_->subscribe({"/cmd_vel", message_type<msg::TwistStamped>(), false}, [](ByteView) {});
    using msg::Trigger;
    for (const char* service : kServices)
      node_->serve(
          {service, Trigger::kType, message_type<Trigger::Request>(), message_type<Trigger::Response>()},
          [this, service](ByteView) -> std::optional<Bytes> {
            return encode(Trigger::Response{true, "call " + std::to_string(++calls[service])});
          });
  }

  /// Publishes at 50 Hz and answers, once.
  void step() {
    if (const auto now = std::chrono::steady_clock::now(); now >= next_) {
      for (const auto& publisher : publishers_) publisher->publish(ros2::encode(ros2::msg::Odometry{}), 0);
      next_ = now + std::chrono::milliseconds(20);
    }
    node_->poll();
    node_->wait(std::chrono::milliseconds(2));
  }

  std::map<std::string, int> calls;

 private:
  std::unique_ptr<live::Middleware> node_;
  std::vector<std::unique_ptr<live::Publisher>> publishers_;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace astro::support
