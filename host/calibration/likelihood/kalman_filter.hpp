#pragma once

#include <span>

#include "host/calibration/likelihood/huber.hpp"
#include "host/calibration/likelihood/matrix3.hpp"
#include "host/calibration/likelihood/moves.hpp"
#include "host/calibration/likelihood/sample_selection.hpp"
#include "host/calibration/motion/trajectory.hpp"

/// The Kalman filter along a drive: prediction over arcs, update with truth samples, Huber's loss for
/// outliers.
///
/// The state is the robot's pose in the tracker's frame. Everything else, above all the derivatives, is
/// computed by an Accumulator.
///
/// Cost  linear in the samples; the filter itself allocates nothing.
namespace astro::calibration {

/// One prediction step.
struct Prediction {
  const Move& move;
  double cosine = 1, sine = 0;  // of the heading at the beginning
  double dx_m = 0, dy_m = 0;    // in the tracker's frame
  Symmetric3 slip_covariance;   // that the step adds

  /// Rotates a change of the pose from the move's frame into the tracker's frame.
  Vector3 turned(const Vector3& v) const {
    return {cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1], v[2]};
  }
};

/// One measurement update. Without headings the third component of the measurement is a constant that is known
/// with variance 1 and that nothing else depends on: it changes no other component, no likelihood and no
/// derivative, and there is one filter instead of two.
struct Update {
  bool has_heading = false;
  double cosine = 1, sine = 0;          // of the robot's heading, as predicted
  double lever_x_m = 0, lever_y_m = 0;  // from the robot to the tracked body, in the tracker's frame
  Vector3 innovation{};
  Symmetric3 tracker_covariance;   // of the measurement, as the noise model has it; diagonal
  Symmetric3 expected_covariance;  // of the innovation, before Huber's loss
  Symmetric3 expected_weight;      // its inverse
  double expected_chi_square = 0;
  HuberLoss loss;  // of the innovation; its factors are 1 where it is no outlier
  bool is_outlier = false;
  Symmetric3 covariance, weight;  // of the innovation, with the factors of `loss`
  double chi_square = 0;
  Matrix3 gain{};

  int components() const { return has_heading ? 3 : 2; }
  /// H p H' with the measurement's Jacobian H by the state.
  template <class Number>
  SymmetricOf<Number> seen(const SymmetricOf<Number>& p) const {
    SymmetricOf<Number> out = sheared(p, -lever_y_m, lever_x_m);
    if (!has_heading) out.xt = out.yt = out.tt = Number{};
    return out;
  }
  /// p H'.
  Matrix3 with_state(const Symmetric3& p) const;
};

// Squares of Huber's thresholds: 99 % of chi-square with 2 and 3 degrees of freedom.
inline double huber_limit(const Update& step) { return step.has_heading ? 11.345 : 9.210; }

/// Whether the filter uses the values of truth samples. With times alone every innovation is zero.
enum class TruthUse { values, times };

/// Computes results during a pass of the filter. The calls are virtual so that the filter is compiled once and not for each
/// accumulator; compared with the matrix operations of a step, their cost is negligible.
class Accumulator {
 public:
  /// Called after each prediction.
  virtual void predict(const Prediction& step) = 0;
  /// Called before the gain corrects the state.
  virtual void update(const Update& step, Motion motion) = 0;

 protected:
  ~Accumulator() = default;
};

/// Runs the filter along a drive: predicts over its legs and updates with the selected truth samples, each with the motion
/// that took most of the time since the one before. Precondition: a leg ends at each of them.
void filter_run(const Moves& moves, const NoiseModel& noise, RobustMode robust, TruthUse truth,
                const SampleSelection& samples, std::span<Accumulator* const> accumulators);

}  // namespace astro::calibration
