#include "host/calibration/likelihood/kalman_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "host/calibration/motion/wheel_path.hpp"

namespace astro::calibration {
namespace {

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
    const ExpectedBody expected = expected_body(state_, u_);
    Update step;
    step.has_heading = has_headings_;
    step.heading_rad = state_[2];
    step.jacobian_state = expected.jacobian_state;
    step.jacobian_lever = expected.jacobian_lever;
    if (!has_headings_) {
      step.jacobian_state.row(2).setZero();
      step.jacobian_lever.row(2).setZero();
    }
    step.innovation = innovation(sample, expected.pose);
    step.tracker_covariance = tracker_covariance();
    Eigen::Matrix3d ph = covariance_ * step.jacobian_state.transpose();
    step.expected_covariance = step.jacobian_state * ph + step.tracker_covariance;
    step.expected_weight = step.expected_covariance.inverse();
    step.expected_chi_square = step.innovation.dot(step.expected_weight * step.innovation);
    down_weight(step, ph);
    step.gain = ph * step.weight;
    accumulator_.update(step, motion);

    state_ += step.gain * step.innovation;
    covariance_ -= step.gain * ph.transpose();
    covariance_ = (covariance_ + covariance_.transpose().eval()) / 2;
  }

 private:
  Eigen::Vector3d innovation(const BodySample& sample, const Eigen::Vector3d& expected) const {
    if (truth_ == TruthUse::times) return Eigen::Vector3d::Zero();
    return {sample.x_m - expected[0], sample.y_m - expected[1],
            has_headings_ ? std::remainder(sample.theta_rad - expected[2], 2 * std::numbers::pi) : 0};
  }

  Eigen::Matrix3d tracker_covariance() const {
    constexpr double kOfTheConstant = 1;  // stands for the heading where there is none; see Update
    const double xy = noise_.sigma_xy_m * noise_.sigma_xy_m;
    const double theta = has_headings_ ? noise_.sigma_theta_rad * noise_.sigma_theta_rad : kOfTheConstant;
    return Eigen::Vector3d(xy, xy, theta).asDiagonal();
  }

  /// An outlier gets the covariance of wheels that slipped and a tracker that erred more than usual. `ph` is
  /// the covariance of state and measurement.
  void down_weight(Update& step, Eigen::Matrix3d& ph) {
    step.is_outlier = robust_ != RobustMode::none && step.expected_chi_square > huber_limit(step);
    step.covariance = step.expected_covariance;
    step.weight = step.expected_weight;
    step.chi_square = step.expected_chi_square;
    step.loss.cost = step.chi_square;
    if (!step.is_outlier) return;
    const Eigen::Matrix3d slip = step.expected_covariance - step.tracker_covariance;
    step.loss =
        huber_loss(step.innovation, slip, step.tracker_covariance.diagonal(), huber_limit(step), robust_);
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

}  // namespace

void filter_run(const PreparedRun& run, const Unknowns& u, const NoiseModel& noise, RobustMode robust,
                TruthUse truth, const SampleSelection& samples, Accumulator& accumulator) {
  KalmanFilter filter(run, u, noise, robust, truth, accumulator);
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
