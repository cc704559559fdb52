#pragma once

#include <cstdint>

/// Arithmetic of running counts, which wrap at 2^32: of encoders, forward positive. The language leaves an overflow of
/// signed numbers undefined, so these go through unsigned ones.
namespace astro {

/// How far a running count went from `before` to `now`. Precondition: by less than 2^31.
constexpr std::int32_t wrapping_difference(std::int32_t now, std::int32_t before) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(now) - static_cast<std::uint32_t>(before));
}

constexpr std::int32_t wrapping_sum(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}

constexpr std::int32_t wrapping_product(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}

static_assert(wrapping_difference(-2'147'483'647, 2'147'483'646) == 3);
static_assert(wrapping_difference(2'147'483'646, -2'147'483'647) == -3);
static_assert(wrapping_sum(2'147'483'646, 3) == -2'147'483'647);
static_assert(wrapping_product(INT32_MIN, -1) == INT32_MIN);

}  // namespace astro
