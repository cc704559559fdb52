#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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
/// above all, is the work of an accumulator:
///
///   void predict(const Prediction&);   // after each prediction
///   template <int N>
///   void update(const Update<N>&, const BodySample&, Motion);   // before the gain moves the state
///
/// Cost  linear in the samples; nothing is allocated.
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

/// One measurement update; N is 3 with headings and 2 without.
template <int N>
struct Update {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;

  double heading_rad = 0;                                      // of the robot, as predicted
  Eigen::Matrix<double, N, 3> jacobian_state, jacobian_lever;  // of the measurement
  Vector innovation;
  Square tracker_covariance;   // of the measurement, as the noise model has it
  Square expected_covariance;  // of the innovation, before Huber's loss
  Square expected_weight;      // its inverse
  double expected_chi_square = 0;
  HuberLoss loss;  // of the innovation; its factors are 1 where it is no outlier
  bool is_outlier = false;
  Square covariance, weight;  // of the innovation, with the factors of `loss`
  double chi_square = 0;
  Eigen::Matrix<double, 3, N> gain;
};

// Squares of Huber's thresholds: 99 % of chi-square with 2 and 3 degrees of freedom.
template <int N>
inline constexpr double kHuberLimit = N == 3 ? 11.345 : 9.210;

/// Whether the filter uses the values of truth samples. With times alone every innovation is zero.
enum class TruthUse { values, times };

template <class Accumulator>
class KalmanFilter {
 public:
  /// All references must outlive the filter.
  KalmanFilter(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise, RobustMode robust,
               TruthUse truth, Accumulator& accumulator)
      : u_(unknowns),
        noise_(noise),
        robust_(robust),
        truth_(truth),
        has_headings_(run.has_headings),
        accumulator_(accumulator),
        state_(unknowns.segment<3>(kStartX)) {}

  void predict(const Moment& from, const WheelState& wheels_from, const Moment& to,
               const WheelState& wheels_to, Motion motion) {
    const double left_m = wheels_to.left_m - wheels_from.left_m;
    const double right_m = wheels_to.right_m - wheels_from.right_m;
    if (left_m == 0 && right_m == 0) return;
    const Arc arc = arc_of(state_[2], u_[kCLeft] * left_m, u_[kCRight] * right_m, u_[kB]);
    const Prediction step{
        from,   to,      wheels_from, wheels_to,       motion,
        left_m, right_m, arc,         transition(arc), noise_.K_m * slip_per_K(arc, left_m, right_m)};
    state_ += Eigen::Vector3d(arc.dx_m, arc.dy_m, arc.turn_rad);
    covariance_ = step.transition * covariance_ * step.transition.transpose() + step.slip_covariance;
    accumulator_.predict(step);
  }

  void update(const BodySample& sample, Motion motion) {
    if (has_headings_) {
      update_with<3>(sample, motion);
    } else {
      update_with<2>(sample, motion);
    }
  }

 private:
  template <int N>
  typename Update<N>::Vector innovation(const BodySample& sample, const Eigen::Vector3d& expected) const {
    typename Update<N>::Vector r = Update<N>::Vector::Zero();
    if (truth_ == TruthUse::times) return r;
    r[0] = sample.x_m - expected[0];
    r[1] = sample.y_m - expected[1];
    if constexpr (N == 3) r[2] = std::remainder(sample.theta_rad - expected[2], 2 * std::numbers::pi);
    return r;
  }

  template <int N>
  typename Update<N>::Square tracker_covariance() const {
    typename Update<N>::Square tracker = Update<N>::Square::Zero();
    tracker.diagonal().template head<2>().array() += noise_.sigma_xy_m * noise_.sigma_xy_m;
    if constexpr (N == 3) tracker(2, 2) += noise_.sigma_theta_rad * noise_.sigma_theta_rad;
    return tracker;
  }

  template <int N>
  void update_with(const BodySample& sample, Motion motion) {
    const ExpectedBody expected = expected_body(state_, u_);
    Update<N> step;
    step.heading_rad = state_[2];
    step.jacobian_state = expected.jacobian_state.topRows<N>();
    step.jacobian_lever = expected.jacobian_lever.topRows<N>();
    step.innovation = innovation<N>(sample, expected.pose);
    step.tracker_covariance = tracker_covariance<N>();
    Eigen::Matrix<double, 3, N> ph = covariance_ * step.jacobian_state.transpose();
    step.expected_covariance = step.jacobian_state * ph + step.tracker_covariance;
    step.expected_weight = step.expected_covariance.inverse();
    step.expected_chi_square = step.innovation.dot(step.expected_weight * step.innovation);
    down_weight(step, ph);
    step.gain = ph * step.weight;
    accumulator_.template update<N>(step, sample, motion);

    state_ += step.gain * step.innovation;
    covariance_ -= step.gain * ph.transpose();
    covariance_ = (covariance_ + covariance_.transpose().eval()) / 2;
  }

  /// An outlier gets the covariance of wheels that slipped and a tracker that erred more than usual. `ph` is
  /// the covariance of state and measurement.
  template <int N>
  void down_weight(Update<N>& step, Eigen::Matrix<double, 3, N>& ph) {
    step.is_outlier = robust_ != RobustMode::none && step.expected_chi_square > kHuberLimit<N>;
    step.covariance = step.expected_covariance;
    step.weight = step.expected_weight;
    step.chi_square = step.expected_chi_square;
    step.loss.cost = step.chi_square;
    if (!step.is_outlier) return;
    const typename Update<N>::Square slip = step.expected_covariance - step.tracker_covariance;
    step.loss =
        huber_loss<N>(step.innovation, slip, step.tracker_covariance.diagonal(), kHuberLimit<N>, robust_);
    covariance_ *= step.loss.slip;
    ph *= step.loss.slip;
    step.covariance = step.loss.slip * slip + step.loss.tracker * step.tracker_covariance;
    step.weight = step.covariance.inverse();
    step.chi_square = step.innovation.dot(step.weight * step.innovation);
  }

  const Unknowns& u_;
  const NoiseModel& noise_;
  const RobustMode robust_;
  const TruthUse truth_;
  const bool has_headings_;
  Accumulator& accumulator_;
  Eigen::Vector3d state_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

/// Runs the filter along a drive: predicts over arcs of at most kLongestStep_s and updates with the selected
/// truth samples, each with the motion that took most of the time since the one before.
template <class Accumulator>
void filter_run(const PreparedRun& run, const Unknowns& u, const SampleSelection& samples,
                KalmanFilter<Accumulator>& filter) {
  const WheelPath wheels(run.source->wheels);
  const auto moment = [&](double truth_time_s) {
    const double since_middle_s = truth_time_s - run.clock_middle_s;
    return Moment{truth_time_s + u[kClockOffset] + u[kSkew] * since_middle_s, since_middle_s};
  };
  Moment from = moment(run.truth.front().time_s);
  WheelState wheels_from = wheels.at(from.time_s);
  std::array<double, 4> spent_s{};  // by Motion
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const Moment end = moment(run.truth[i].time_s);
    const int steps =
        i == 0 ? 0 : std::max(1, static_cast<int>(std::ceil((end.time_s - from.time_s) / kLongestStep_s)));
    const Moment begin = from;
    for (int step = 1; step <= steps; ++step) {
      const double part = static_cast<double>(step) / steps;
      const Moment to{begin.time_s + part * (end.time_s - begin.time_s),
                      begin.jacobian_skew_s + part * (end.jacobian_skew_s - begin.jacobian_skew_s)};
      const WheelState wheels_to = wheels.at(to.time_s);
      filter.predict(from, wheels_from, to, wheels_to, run.motion[i]);
      from = to;
      wheels_from = wheels_to;
    }
    spent_s[static_cast<std::size_t>(run.motion[i])] += end.time_s - begin.time_s;
    if (static_cast<int>(i) % samples.stride != samples.first) continue;
    const auto most = std::max_element(spent_s.begin(), spent_s.end());
    filter.update(run.truth[i], *most > 0 ? static_cast<Motion>(most - spent_s.begin()) : run.motion[i]);
    spent_s.fill(0);
  }
}

}  // namespace astro::calibration
