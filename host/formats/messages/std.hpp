#pragma once

#include <cstdint>

#include "host/formats/cdr/cdr.hpp"
#include "host/formats/cdr/message.hpp"

/// builtin_interfaces, std_msgs, rosgraph_msgs and std_srvs: times, headers, texts, and services without data.
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

struct String {
  std::string data;

  static constexpr std::string_view kType = "std_msgs/msg/String";
  static constexpr std::tuple kFields{Field{&String::data, "data"}};
  bool operator==(const String&) const = default;
};

/// The time of a simulation.
struct Clock {
  Time clock;

  static constexpr std::string_view kType = "rosgraph_msgs/msg/Clock";
  static constexpr std::tuple kFields{Field{&Clock::clock, "clock"}};
  bool operator==(const Clock&) const = default;
};

/// A service is a struct with the messages Request and Response, and the name of its type.
struct Trigger {
  static constexpr std::string_view kType = "std_srvs/srv/Trigger";

  struct Request {
    static constexpr std::string_view kType = "std_srvs/srv/Trigger_Request";
    static constexpr std::tuple<> kFields{};
    bool operator==(const Request&) const = default;
  };

  struct Response {
    bool success = false;
    std::string message;

    static constexpr std::string_view kType = "std_srvs/srv/Trigger_Response";
    static constexpr std::tuple kFields{Field{&Response::success, "success"},
                                        Field{&Response::message, "message"}};
    bool operator==(const Response&) const = default;
  };
};

struct SetBool {
  static constexpr std::string_view kType = "std_srvs/srv/SetBool";

  struct Request {
    bool data = false;

    static constexpr std::string_view kType = "std_srvs/srv/SetBool_Request";
    static constexpr std::tuple kFields{Field{&Request::data, "data"}};
    bool operator==(const Request&) const = default;
  };

  struct Response {
    bool success = false;
    std::string message;

    static constexpr std::string_view kType = "std_srvs/srv/SetBool_Response";
    static constexpr std::tuple kFields{Field{&Response::success, "success"},
                                        Field{&Response::message, "message"}};
    bool operator==(const Response&) const = default;
  };
};

}  // namespace astro::ros2::msg
