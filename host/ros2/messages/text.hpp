#pragma once

#include "host/ros2/cdr/message.hpp"

namespace astro::ros2::msg {

struct String {
  std::string data;

  static constexpr std::string_view kType = "std_msgs/msg/String";
  static constexpr std::tuple kFields{Field{&String::data, "data"}};
  bool operator==(const String&) const = default;
};

}  // namespace astro::ros2::msg
