#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

/// A drive in front of a straight wall as the estimator uses it. Each time the robot has squared itself against the wall, its
/// heading is that of the wall, except for whole turns. After some squarings the robot backed off, and somebody read the gap
/// between the wall and its front.
namespace astro::wall {

/// Travel of the wheels since any start, in metres of a nominal wheel (c_R = c_L = 1), forward positive; and the same without
/// signs, because a wheel slips whichever way it rolls.
struct WheelTravel {
  double right_m = 0, left_m = 0;
  double right_path_m = 0, left_path_m = 0;

  friend WheelTravel operator-(const WheelTravel& a, const WheelTravel& b) {
    return {a.right_m - b.right_m, a.left_m - b.left_m, a.right_path_m - b.right_path_m,
            a.left_path_m - b.left_path_m};
  }
  double path_m() const { return right_path_m + left_path_m; }  // of both wheels
};

/// The gap between wall and front of the robot as somebody read it, square to the wall, after the robot backed straight off.
struct GapReading {
  WheelTravel travel;
  double gap_m = 0;
  std::size_t squaring = 0;  // the last one before it: number in its series
};

/// Squarings in their order, between which nobody lifted or pushed the robot.
struct WallSeries {
  std::vector<WheelTravel> squarings;
  std::vector<GapReading> readings;
};

using WallDrive = std::vector<WallSeries>;

/// The noise of such a drive. K_m is as in NoiseModel: the variance of a wheel's slip for each metre that it
/// rolls.
struct WallNoise {
  double K_m = 2.645e-6;
  double squaring_rad = 1.5e-3;  // of the heading of a robot that stands flush: play, an uneven wall
  double reading_m = 5e-4;       // of a gap
  double contact_m = 5e-4;  // of the gap that a robot has while it stands flush, the same in all readings
};

}  // namespace astro::wall
