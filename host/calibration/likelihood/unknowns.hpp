#pragma once

#include <Eigen/Core>

/// The unknowns of the maximum-likelihood estimate, in the order of every vector and matrix about them.
namespace astro::calibration {

/// The first seven are shared by all runs, the next four belong to each run.
enum Unknown : int {
  kCRight,
  kCLeft,
  kB,
  kLeverX,
  kLeverY,
  kLeverYaw,
  kSkew,
  kStartX,
  kStartY,
  kStartTheta,
  kClockOffset,
  kArcWheelbase,  // the wheelbase in arcs is b (1 + this); it stays zero, only its derivative is used
  kUnknowns
};
inline constexpr int kShared = kSkew + 1, kOwn = kClockOffset + 1 - kShared;

/// In units of m, rad and s.
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

}  // namespace astro::calibration
