#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "host/base/remedy.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/wall/drive_against_wall.hpp"
#include "host/calibration/wall/wall_headings.hpp"
#include "host/calibration/wall/wall_scale.hpp"

/// Wheel factors from a drive against a wall: E_d and b / S from headings (wall_headings.hpp), S from gaps that somebody read
/// (wall_scale.hpp). All are absolute: they do not depend on the factors that the robot carried.
///
/// Not seen  e, the other wheelbase of gentle arcs: b is that of turns on the spot, and e is kept as loaded.
namespace astro::calibration {

struct WallErrors {
  double E_d = 0;
  double b = 0;      // of b / S, relative
  double scale = 0;  // NaN if no gap was read
};

struct WallEstimate {
  WheelFactors factors;  // what to load; without a gap the loaded (c_R + c_L) / 2 is kept
  double E_d = 1, b_per_scale_m = 0;
  std::optional<WallScale> scale;
  WallErrors se;
  Eigen::Matrix3d covariance;  // of c_R, c_L, b; without a gap as if the loaded scale were exact
  WallNoise noise;             // K and the error of a squaring as the drive shows them
  HeadingFit headings;         // of this noise
  std::vector<Stretch> stretches;
};

/// Precondition  a series of two squarings or more, or `loaded` is all that comes out.
WallEstimate estimate_wall(const WallDrive& drive, const WheelFactors& loaded, const WallNoise& usual = {});

/// What is wrong with the last squaring of a drive, by the stretch that ends there: a heading that is far from whole turns, or a wall that was not where it
/// was before. Nothing if it fits. `expected`: the estimate without it; `further_m`: by how much further the robot had to go to the
/// wall than if it had come back to where it started.
struct SquaringDoubt {
  enum class Kind {
    turned,     // not a whole number of turns, by more than wheels slip: lifted, pushed, or a wheel spun
    too_early,  // something stands between robot and wall, or the wheels spun on the way out
    too_late,   // the wall gave way, or the wheels spun on the way in
  };
  Kind kind;
  double off = 0;      // rad, or m
  double allowed = 0;  // the same unit
  std::string fact;    // one clause
};
std::optional<SquaringDoubt> doubt_about_squaring(const WallSeries& series, const WallEstimate& expected,
                                                  double further_m);

/// How far the robot must stop before the wall so that it does not reach it while it still drives by its set points, although it may
/// have slipped, and turned a corner ahead: three standard deviations and `at_least_m`.
double approach_margin_m(const WheelTravel& way, double half_width_m, const WallEstimate& expected,
                         double at_least_m = 0.012);

}  // namespace astro::calibration
