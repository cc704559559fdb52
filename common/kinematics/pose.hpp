#pragma once

#include <cstdint>

#include "common/fixed/angle.hpp"

namespace astro {

/// Pose of the base frame in the odom frame: x forward and y left where the robot stood at (0, 0, 0), theta
/// counter-clockwise.
struct Pose {
  static constexpr int kPositionBits = 40;  // x, y in 2^-40 m, about a picometre; the range is 8000 km
  std::int64_t x = 0;
  std::int64_t y = 0;
  Angle theta;
  std::int32_t turns = 0;  // whole turns, so that turns + theta is the continuous heading

  friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

}  // namespace astro
