#pragma once

#include <cstdint>

#include "common/fixed/angle.hpp"

namespace astro {

/// Sine and cosine as Q20.43: 2^43 is one.
struct SinCos {
  static constexpr int kFractionBits = 43;
  std::int64_t sin = 0;
  std::int64_t cos = 0;
};

/// sin and cos of a binary angle, absolute error below 2^-35 (tests/common/fixed sweeps it); exact at
/// multiples of a quarter turn. Finer than the 2^-30 that a single step needs, because on a straight line the
/// same error is added in every tick: half an hour at 1 m/s must stay within a micrometre.
///
/// Method  table of 64 steps per quarter turn, then Taylor to the fourth power of the rest (at most 0.0123
/// rad). Cost    constant, about 60 instructions, no division; callable from the control tick.
SinCos sin_cos(Angle angle);

}  // namespace astro
