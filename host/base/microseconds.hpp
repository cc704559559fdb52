#pragma once

#include <chrono>
#include <cstdint>

namespace astro {

/// Times and durations on a link. Whose clock is read, and whether it is a real one, is said where they are used.
using std::chrono::microseconds;

/// A time of a recording, which has nanoseconds. Rounded down also before the epoch, so that steps of time stay even.
constexpr std::int64_t whole_microseconds(std::int64_t time_ns) {
  return (time_ns - (time_ns % 1000 + 1000) % 1000) / 1000;
}

}  // namespace astro
