#pragma once

#include <Eigen/Core>
#include <vector>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/wall/drive_against_wall.hpp"

/// What the headings of a drive against a wall tell: between two squarings the robot has turned by whole turns,
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
namespace astro::calibration {

struct HeadingFit {
  Eigen::Vector2d a;           // a_R, a_L in 1/m
  Eigen::Matrix2d covariance;  // of these
  /// 2 pi n - (a_R R - a_L L) of each stretch, in the order of the drive.
  std::vector<double> residual_rad;
  double chi_square = 0;  // of the residuals with their covariance
  int stretches = 0;
  /// Of the residuals alone, without what any a would explain (REML), but for a constant.
  double log_likelihood = 0;
};

/// A stretch between two squarings of a drive, with the turns that it contains.
struct Stretch {
  WheelTravel travel;
  double turned_rad = 0;  // a whole multiple of 2 pi
  bool first = true;      // of its series: shares no squaring with the stretch before
};

/// Weak knowledge that keeps a drive of lines alone determined: a wheelbase within 5 % and a ratio of the wheels within 2 % of the
/// loaded factors. Any turn or line outweighs it by far.
HeadingFit fit_headings(const std::vector<Stretch>& stretches, const WheelFactors& loaded,
                        const WallNoise& noise);

/// By how much the heading after `travel` is uncertain for a robot with these a, slip and both squarings included: variance,
/// rad^2.
double heading_variance(const WheelTravel& travel, const HeadingFit& fit, const WallNoise& noise);

/// K and the error of a squaring as the drive itself shows them: the most likely ones (REML), with what is usual as knowledge
/// beforehand: `usual`, K known to a factor of two, which is worth four stretches, the squaring to a factor of three.
WallNoise noise_of(const std::vector<Stretch>& stretches, const WheelFactors& loaded, const WallNoise& usual);

}  // namespace astro::calibration
