#pragma once

#include <cstdint>

namespace astro {

/// Rounded down also before the epoch, so that steps of time stay even.
constexpr std::int64_t whole_microseconds(std::int64_t time_ns) {
  return (time_ns - (time_ns % 1000 + 1000) % 1000) / 1000;
}

}  // namespace astro
