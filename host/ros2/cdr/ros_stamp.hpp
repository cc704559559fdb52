#pragma once

#include <cstdint>

#include "host/ros2/cdr.hpp"

/// builtin_interfaces/Time: seconds (i32) and nanoseconds (u32).
namespace astro::ros2 {

inline constexpr std::int64_t kNanosPerSecond = 1'000'000'000;

/// Precondition: within 2^31 s.
inline void put_time_ns(CdrWriter& out, std::int64_t time_ns) {
  std::int64_t nanos = time_ns % kNanosPerSecond;
  if (nanos < 0) nanos += kNanosPerSecond;
  out.number(static_cast<std::int32_t>((time_ns - nanos) / kNanosPerSecond));
  out.number(static_cast<std::uint32_t>(nanos));
}

/// Any two numbers make a time: the largest is 2^31 + 4 s.
inline std::int64_t take_time_ns(CdrReader& in) {
  const std::int64_t seconds = in.number<std::int32_t>();
  return seconds * kNanosPerSecond + in.number<std::uint32_t>();
}

}  // namespace astro::ros2
