#pragma once

#include <Eigen/Core>

#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// The unknowns of the maximum-likelihood estimate, in the order of every vector and matrix about them.
namespace astro::calibration {

/// The factors are shared by all runs, the lever arm and the skew by the runs of a session, and the others belong to each run.
enum Unknown : int {
  kCRight,
  kCLeft,
  kB,
  kE,
  kLeverX,
  kLeverY,
  kLeverYaw,
  kSkew,
  kStartX,
  kStartY,
  kStartTheta,
  kClockOffset,
  kUnknowns
};
inline constexpr int kFactors = kE + 1, kOfSession = kSkew + 1 - kFactors;
inline constexpr int kShared = kFactors + kOfSession, kOwn = kUnknowns - kShared;

/// In units of m, rad and s.
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

inline WheelFactors factors_of(const Unknowns& u) { return {u[kCRight], u[kCLeft], u[kB], u[kE]}; }
inline LeverArm lever_of(const Unknowns& u) { return {u[kLeverX], u[kLeverY], u[kLeverYaw]}; }

}  // namespace astro::calibration
