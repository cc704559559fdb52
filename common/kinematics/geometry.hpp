#pragma once

#include <cstdint>

#include "common/kinematics/effective_base.hpp"
#include "common/params/parameter_set.hpp"

namespace astro {

/// The effect of one encoder count, from the parameters c_R, c_L, b, e, kappa0, wheel diameter, counts per revolution
/// and gear ratio, in the units of the tick. Computed exactly once per parameter change, then rounded once.
///
///   travel of a wheel per count     c * pi * D / (n * gear)                 metres
///   turn of the robot per count     travel / (2 pi b) = c * D / (2 n gear b)   turns
///
/// Source  thesis (5)-(9) with c_R, c_L of Borenstein & Feng.
struct Geometry {
  struct Wheel {
    std::int64_t half_travel = 0;  // 2^-61 m per count: the robot's centre moves half as far as the wheel
    std::int64_t turn = 0;         // 2^-64 turn per count; positive for both wheels
    std::int64_t speed = 0;        // (2^-12 um/s) per (count per tick)
  };
  Wheel left, right;
  std::int32_t half_base_30 = 0;     // b / 2 in 2^-30 m
  std::int32_t inverse_base_25 = 0;  // 1 / b in 2^-25 1/m
  EffectiveBase effective_base;      // how far the wheelbase is from b
};

inline constexpr std::int32_t kTickHz = 1000;

/// Precondition: `set` is valid (common/params). Every result then fits, for up to 2^9 counts per tick.
[[gnu::cold]] Geometry make_geometry(const ParameterSet& set);

}  // namespace astro
