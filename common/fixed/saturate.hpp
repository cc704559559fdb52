#pragma once

#include <cstdint>

namespace astro {

constexpr std::int32_t saturate32(std::int64_t value) {
  if (value > INT32_MAX) return INT32_MAX;
  if (value < INT32_MIN) return INT32_MIN;
  return static_cast<std::int32_t>(value);
}

/// `value` held within [-limit, limit]; limit >= 0.
template <class Int>
constexpr Int clamp_abs(Int value, Int limit) {
  if (value > limit) return limit;
  if (value < -limit) return -limit;
  return value;
}

}  // namespace astro
