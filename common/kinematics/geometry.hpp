#pragma once

#include <cstdint>

#include "common/params/parameter_set.hpp"

namespace astro {

/// What the parameters c_R, c_L, b, wheel diameter, counts per revolution and gear ratio mean for one encoder
/// count, in the units that the tick works in. Computed once per parameter change, exactly, then rounded
/// once.
///
///   travel of a wheel per count     c * pi * D / (n * gear)                 metres
///   turn of the robot per count     travel / (2 pi b) = c * D / (2 n gear b)   turns
///
/// Source  thesis (5)-(9) with c_R, c_L of Borenstein & Feng.
struct Geometry {
  struct Wheel {
    std::int64_t half_travel = 0;  // 2^-61 m per count: what one count adds to the path of the robot's centre
    std::int64_t turn = 0;         // 2^-64 turn per count; positive for both wheels
    std::int64_t speed = 0;        // (2^-12 um/s) per (count per tick)
  };
  Wheel left, right;
  std::int32_t half_base_30 = 0;     // b / 2 in 2^-30 m
  std::int32_t inverse_base_25 = 0;  // 1 / b in 2^-25 1/m
};

inline constexpr std::int32_t kTickHz = 1000;

/// `set` must be valid (common/params): every result then fits with room for 2^9 counts per tick.
[[gnu::cold]] Geometry make_geometry(const ParameterSet& set);

}  // namespace astro
