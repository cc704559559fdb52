#pragma once

#include <Eigen/Core>

#include "host/calibration/likelihood/huber.hpp"
#include "host/calibration/likelihood/motion_model.hpp"
#include "host/calibration/likelihood/robust_mode.hpp"
#include "host/calibration/likelihood/sample_selection.hpp"
#include "host/calibration/likelihood/unknowns.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_path.hpp"
#include "host/calibration/preparation/prepared_run.hpp"

/// THE Kalman filter along a drive: prediction over arcs, update with truth samples, Huber's loss for
/// outliers.
///
/// The state is the robot's pose in the tracker's frame. What else is computed along the way, the derivatives
/// above all, is the work of an Accumulator.
///
/// Cost  linear in the samples; the filter itself allocates nothing.
namespace astro::calibration {

/// A moment on the robot's clock, and its derivative by the skew of the clocks.
struct Moment {
  double time_s = 0, jacobian_skew_s = 0;
};

/// One prediction step: the arc between two moments.
struct Prediction {
  Moment from, to;
  WheelState wheels_from, wheels_to;
  Motion motion = Motion::rest;
  double left_m = 0, right_m = 0;  // travel of the nominal wheels
  Arc arc;
  Eigen::Matrix3d transition;       // Jacobian of the new state by the old one
  Eigen::Matrix3d slip_covariance;  // that the step adds
};

/// One measurement update. Without headings the third component of the measurement is a constant that is known
/// with variance 1 and that nothing else depends on: it changes no other component, no likelihood and no
/// derivative, and there is one filter instead of two.
struct Update {
  bool has_heading = false;
  double heading_rad = 0;                          // of the robot, as predicted
  Eigen::Matrix3d jacobian_state, jacobian_lever;  // of the measurement
  Eigen::Vector3d innovation;
  Eigen::Matrix3d tracker_covariance;   // of the measurement, as the noise model has it
  Eigen::Matrix3d expected_covariance;  // of the innovation, before Huber's loss
  Eigen::Matrix3d expected_weight;      // its inverse
  double expected_chi_square = 0;
  HuberLoss loss;  // of the innovation; its factors are 1 where it is no outlier
  bool is_outlier = false;
  Eigen::Matrix3d covariance, weight;  // of the innovation, with the factors of `loss`
  double chi_square = 0;
  Eigen::Matrix3d gain;

  int components() const { return has_heading ? 3 : 2; }
};

// Squares of Huber's thresholds: 99 % of chi-square with 2 and 3 degrees of freedom.
inline double huber_limit(const Update& step) { return step.has_heading ? 11.345 : 9.210; }

/// Whether the filter uses the values of truth samples. With times alone every innovation is zero.
enum class TruthUse { values, times };

/// What a pass of the filter is made for. The calls are virtual so that the filter is compiled once and not for
/// each accumulator; beside the matrices of a step, a call costs nothing.
class Accumulator {
 public:
  /// After each prediction.
  virtual void predict(const Prediction& step) = 0;
  /// Before the gain moves the state.
  virtual void update(const Update& step, Motion motion) = 0;

 protected:
  ~Accumulator() = default;
};

/// Runs the filter along a drive: predicts over arcs of at most kLongestStep_s and updates with the selected
/// truth samples, each with the motion that took most of the time since the one before.
void filter_run(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise, RobustMode robust,
                TruthUse truth, const SampleSelection& samples, Accumulator& accumulator);

}  // namespace astro::calibration
