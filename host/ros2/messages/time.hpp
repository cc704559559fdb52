#pragma once

#include <cstdint>

#include "host/ros2/cdr/message.hpp"
#include "host/ros2/cdr/ros_stamp.hpp"

namespace astro::ros2::msg {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;

  static constexpr std::string_view kType = "builtin_interfaces/msg/Time";
  static constexpr std::tuple kFields{Field{&Time::sec, "sec"}, Field{&Time::nanosec, "nanosec"}};
  bool operator==(const Time&) const = default;
};

/// Precondition: within 2^31 s.
constexpr Time to_time(std::int64_t ns) {
  const std::int64_t nanos = ((ns % kNanosPerSecond) + kNanosPerSecond) % kNanosPerSecond;
  return {static_cast<std::int32_t>((ns - nanos) / kNanosPerSecond), static_cast<std::uint32_t>(nanos)};
}

constexpr std::int64_t nanoseconds(const Time& time) {
  return time.sec * kNanosPerSecond + static_cast<std::int64_t>(time.nanosec);
}

struct Header {
  Time stamp;
  std::string frame_id;

  static constexpr std::string_view kType = "std_msgs/msg/Header";
  static constexpr std::tuple kFields{Field{&Header::stamp, "stamp"}, Field{&Header::frame_id, "frame_id"}};
  bool operator==(const Header&) const = default;
};

}  // namespace astro::ros2::msg
