#pragma once

#include "host/ros2/messages/time.hpp"

namespace astro::ros2::msg {

/// The time of a simulation.
struct Clock {
  Time clock;

  static constexpr std::string_view kType = "rosgraph_msgs/msg/Clock";
  static constexpr std::tuple kFields{Field{&Clock::clock, "clock"}};
  bool operator==(const Clock&) const = default;
};

}  // namespace astro::ros2::msg
