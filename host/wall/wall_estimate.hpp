#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/wall/drive_against_wall.hpp"
#include "host/wall/wall_scale.hpp"

/// Wheel factors from a drive against a wall: E_d and b / S from headings, S from gaps that somebody read
/// (wall_scale.hpp). All are absolute: they do not depend on the factors that the robot carried.
///
/// Not seen  e, the other wheelbase of gentle arcs: b is that of turns on the spot, and e is kept as loaded.
namespace astro::wall {

/// A fit of the headings of a drive against a wall. Between two squarings the robot has turned by whole turns,
///
///   2 pi n = a_R R - a_L L + slip + e2 - e1,     a_R = c_R / b,  a_L = c_L / b
///
/// R and L the nominal travels of the wheels in between, e1 and e2 the errors of the squarings. That is linear in a_R and
/// a_L. Lines (R = L) show a_R - a_L, that is E_d; turns on the spot (R = -L) show a_R + a_L, that is S / b.
///
/// Slip has variance K a^2 for each metre that a wheel rolls. A squaring's error enters the stretch before it and, with the other
/// sign, the one behind it.
///
/// Cost  cubic in the number of squarings of a series: 60 of them take about 0.1 ms.
struct HeadingFit {
  Eigen::Vector2d a;           // a_R, a_L in 1/m
  Eigen::Matrix2d covariance;  // of these
  /// 2 pi n - (a_R R - a_L L) of each stretch, in the order of the drive.
  std::vector<double> residual_rad;
  double chi_square = 0;  // of the residuals with their covariance
  int stretches = 0;
  /// The restricted log likelihood (REML), which does not depend on a, up to a constant.
  double log_likelihood = 0;
};

/// A stretch between two squarings of a drive, with the turns that it contains.
struct Stretch {
  WheelTravel travel;
  double turned_rad = 0;  // a whole multiple of 2 pi
  bool first = true;      // of its series: shares no squaring with the stretch before
};

/// Uses a weak prior, so that a drive of lines alone is determined, too: a wheelbase within 5 % and a ratio of the wheels
/// within 2 % of the loaded factors. Any turn or line outweighs it by far.
HeadingFit fit_headings(const std::vector<Stretch>& stretches, const calibration::WheelFactors& loaded,
                        const WallNoise& noise);

/// The variance of the heading after `travel`, in rad^2, from the uncertainty of a, slip and both squarings.
double heading_variance(const WheelTravel& travel, const HeadingFit& fit, const WallNoise& noise);

/// K and the error of a squaring as the drive itself shows them: the most likely ones (REML) with `usual` as the prior. The
/// prior knows K to a factor of two, which has the weight of four stretches, and the error of a squaring to a factor of three.
WallNoise noise_of(const std::vector<Stretch>& stretches, const calibration::WheelFactors& loaded,
                   const WallNoise& usual);

struct WallErrors {
  double E_d = 0;
  double b = 0;      // of b / S, relative
  double scale = 0;  // NaN if no gap was read
};

struct WallEstimate {
  calibration::WheelFactors factors;  // what to load; without a gap the loaded (c_R + c_L) / 2 is kept
  double E_d = 1, b_per_scale_m = 0;
  std::optional<WallScale> scale;
  WallErrors se;
  Eigen::Matrix3d covariance;  // of c_R, c_L, b; without a gap as if the loaded scale were exact
  WallNoise noise;             // K and the error of a squaring as the drive shows them
  HeadingFit headings;         // of this noise
  std::vector<Stretch> stretches;
};

/// Precondition  a series of two squarings or more; otherwise the result is `loaded`.
WallEstimate estimate_wall(const WallDrive& drive, const calibration::WheelFactors& loaded,
                           const WallNoise& usual = {});

/// What is wrong with the last squaring of a drive, judged by the stretch that ends there: the heading is far from whole turns,
/// or the wall is not where it was before. doubt_about_squaring returns nothing if the squaring fits. `expected`: the estimate
/// without it. `further_m`: how much farther the robot had to go to the wall than if it had come back to where it started.
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

/// How far before the wall the robot must stop, so that it does not touch the wall while it still follows its set points. This
/// is `at_least_m` and three standard deviations of slip and of a corner that is ahead because the robot has turned.
double approach_margin_m(const WheelTravel& way, double half_width_m, const WallEstimate& expected,
                         double at_least_m = 0.012);

}  // namespace astro::wall
