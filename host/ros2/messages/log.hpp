#pragma once

#include "host/ros2/messages/time.hpp"

namespace astro::ros2::msg {

struct Log {
  Time stamp;
  std::uint8_t level = 0;
  std::string name, msg, file, function;
  std::uint32_t line = 0;

  static constexpr std::string_view kType = "rcl_interfaces/msg/Log";
  static constexpr std::tuple kFields{Field{&Log::stamp, "stamp"}, Field{&Log::level, "level"},
                                      Field{&Log::name, "name"},   Field{&Log::msg, "msg"},
                                      Field{&Log::file, "file"},   Field{&Log::function, "function"},
                                      Field{&Log::line, "line"}};
  bool operator==(const Log&) const = default;
};

}  // namespace astro::ros2::msg
