#pragma once

#include <chrono>
#include <cstdint>

namespace astro {

/// Times and durations on a link. Their users document which clock is read, and whether it is a real one.
using std::chrono::microseconds;

/// Converts a recording's time, which is in nanoseconds. Rounds down also before the epoch, so that equal time steps stay
/// equal.
constexpr std::int64_t whole_microseconds(std::int64_t time_ns) {
  return (time_ns - (time_ns % 1000 + 1000) % 1000) / 1000;
}

}  // namespace astro
