#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "host/calibration/likelihood/robust_mode.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_path.hpp"
#include "host/calibration/preparation/prepared_run.hpp"

/// The Kalman filter that turns a drive into innovations, with their derivatives by every unknown.
///
/// The state is the robot's pose in the tracker's frame. Between two truth samples it moves by the exact arc
/// of the wheels' travel, with noise of variance K * |travel| per wheel; a truth sample is the pose of the
/// tracked body. Given the right parameters the innovations are white with the covariance that the filter
/// computes, so their weighted sum of squares is, up to terms that hardly depend on the parameters, -2 log
/// likelihood of the whole drive.
///
/// The derivatives are propagated beside the state with the gains held fixed: exact for the linearised
/// filter, one pass for all of them.
namespace astro::calibration {

/// Places of the unknowns. The first seven belong to all runs, the next four to each.
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
  kArcWheelbase,  // the wheelbase of arcs is b (1 + this); zero, only its derivative is used
  kUnknowns
};
inline constexpr int kShared = kSkew + 1, kOwn = kClockOffset + 1 - kShared;

using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// How a filter looks at truth.
struct Looks {
  Doubt doubt = Doubt::nobody;
  int stride = 1;  // at every so many-th sample; the others only say how the robot moved in between
  int first = 0;   // of the samples it looks at; less than stride
};

struct MotionTotals {
  int samples = 0;
  double sum_xy_m2 = 0, sum_theta_rad2 = 0, chi_square = 0;
};

struct InnovationSums {
  Information information = Information::Zero();  // sum of J' S^-1 J
  Unknowns gradient = Unknowns::Zero();           // sum of J' S^-1 r
  double cost = 0;                                // -2 log likelihood, with Huber's loss, up to a constant
  double chi_square = 0;
  int degrees_of_freedom = 0;
  std::array<MotionTotals, 4> motion{};
};

/// Of several passes along one run. Not of none.
InnovationSums mean_of(std::span<const InnovationSums> passes);

/// One pass. `unknowns` in units of m, rad, s.
InnovationSums innovations(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise,
                           const Looks& looks);

/// The innovations themselves, one after the other: ahead, to the left and in heading of the robot, made
/// independent and of variance 1 by the covariance that the filter expects. Without headings the last is 0.
std::vector<Eigen::Vector3d> standard_innovations(const PreparedRun& run, const Unknowns& unknowns,
                                                  const NoiseModel& noise, const Looks& looks);

/// The Fisher information of a run of exactly these unknowns: truth serves by its times alone.
Information expected_information(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise);

/// Slope and curvature of -2 log likelihood in the logarithms of K and of the squares of sigma_xy and
/// sigma_theta, the parameters held: expected curvature, as in Fisher's scoring.
struct NoiseSlope {
  static constexpr int kNoises = 3;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
};
NoiseSlope noise_slope(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise,
                       const Looks& looks);

}  // namespace astro::calibration
