#pragma once

#include <cstdint>

#include "host/ros2/cdr/cdr.hpp"

/// builtin_interfaces/Time: seconds (i32) and nanoseconds (u32).
namespace astro::ros2 {

inline constexpr std::int64_t kNanosPerSecond = 1'000'000'000;

/// Any two numbers make a time: the largest is 2^31 + 4 s.
inline std::int64_t take_time_ns(CdrReader& in) {
  const std::int64_t seconds = in.number<std::int32_t>();
  return seconds * kNanosPerSecond + in.number<std::uint32_t>();
}

}  // namespace astro::ros2
