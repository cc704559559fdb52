#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/closed_form.hpp"
#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// E_d and E_b from all that was measured of the ends: the positions of all runs and the headings of those that have one.
namespace astro::calibration {

/// The squares that were driven: side, and the factors of the odometry during them.
struct SquareSetup {
  double side_m = 0;
  WheelFactors loaded;
};

/// Standard deviations of ln E_d and ln E_b over robots that nobody has calibrated yet.
struct RatioPrior {
  double E_d = 0.01, E_b = 0.03;
};

struct RobustFit {
  double E_d = 1, E_b = 1;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of ln E_d and ln E_b
  /// How much more the ends scatter than end_covariance says: a ratio of variances. Some of it is known before any run,
  /// worth four readings, so that two runs which happen to agree do not seem exact.
  double scatter = 1;
};

/// The most likely ratios if the ends scatter about those of the exact replay (replay.hpp) with covariances in the ratio
/// of end_covariance (end_scatter.hpp) and with the tails of Student's t distribution of six degrees of freedom. So an
/// end that is far from the others counts less the farther it is, and a wrong one among five of its direction moves the
/// result by a fraction of its standard error. The price: for normal scatter the standard errors are 4 % larger than those of
/// least squares.
///
/// `prior`: what is known before any run; without it both directions need runs.
///
/// Errors  throws astro::Error where no ratios explain the ends, not even roughly.
/// Cost    about 30 iterations of ten replays each.
/// Source  robust_weight.hpp
RobustFit fit_ends(std::span<const EndPose> cw, std::span<const EndPose> ccw, const SquareSetup& setup,
                   const std::optional<RatioPrior>& prior = std::nullopt);

/// How far an end that a fit has not seen is from where the fit expects it.
struct Surprise {
  EndPose expected;
  double chi_square = 0;  // of 2 degrees of freedom without a heading, of 3 with one
};

/// Robots that slip less than the default of EndNoise are treated as if they slipped so much, because a few runs do not show
/// that they never will; unless the ends scatter by less than two fifths of its variance.
Surprise surprise_of(const EndPose& end, Sense sense, const RobustFit& fit, const SquareSetup& setup);

/// The ratios with the angles of the fitted robot.
Ratios ratios_of(const RobustFit& fit, const SquareSetup& setup);

}  // namespace astro::calibration
