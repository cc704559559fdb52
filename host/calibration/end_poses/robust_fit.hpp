#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/closed_form.hpp"
#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// E_d and E_b from the measured ends: the positions of all runs, and the headings of the runs that have one.
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
  /// How much more the ends scatter than end_covariance says: a ratio of variances. It has a prior of 1 with the weight of four
  /// readings, so that two runs that happen to agree do not seem exact.
  double scatter = 1;
};

/// The most likely ratios if the ends scatter about those of the exact replay (replay.hpp) with covariances in the ratio of
/// end_covariance (end_scatter.hpp) and with the tails of Student's t distribution of six degrees of freedom. So the weight of
/// an end falls with its distance from the others, and one wrong end among five of its direction moves the result by a fraction
/// of its standard error. The price: for normal scatter the standard errors are 4 % larger than those of least squares.
///
/// `prior`: the distribution of the ratios before any run. Without it, both directions need runs.
///
/// Errors  throws astro::Error if no ratios explain the ends even roughly.
/// Cost    about 30 iterations of ten replays each.
/// Source  robust_weight.hpp
RobustFit fit_ends(std::span<const EndPose> cw, std::span<const EndPose> ccw, const SquareSetup& setup,
                   const std::optional<RatioPrior>& prior = std::nullopt);

/// The distance of an end that the fit did not use from the end that the fit predicts.
struct Surprise {
  EndPose expected;
  double chi_square = 0;  // of 2 degrees of freedom without a heading, of 3 with one
};

/// A scatter below 1, the default of EndNoise, counts as 1, because a few runs do not show that the robot never slips more.
/// Only a scatter below two fifths counts as less than 1, namely as 2.5 times itself.
Surprise surprise_of(const EndPose& end, Sense sense, const RobustFit& fit, const SquareSetup& setup);

/// The ratios with the angles of the fitted robot.
Ratios ratios_of(const RobustFit& fit, const SquareSetup& setup);

}  // namespace astro::calibration
