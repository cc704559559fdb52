#pragma once

#include <cstdint>

namespace astro {

/// Whether serial number `a` is newer than `b`. Serial numbers count up and wrap at 2^32; two that are
/// compared lie less than 2^31 apart.
///
/// Source  RFC 1982, "Serial Number Arithmetic".
constexpr bool is_newer(std::uint32_t a, std::uint32_t b) { return static_cast<std::int32_t>(a - b) > 0; }

static_assert(is_newer(1, 0) && !is_newer(0, 0) && !is_newer(0, 1) && is_newer(0, 0xFFFF'FFFF));

}  // namespace astro
