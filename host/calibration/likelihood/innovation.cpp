#include "host/calibration/likelihood/innovation.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "host/calibration/likelihood/kalman_filter.hpp"

namespace astro::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Propagates the Jacobian of the state by the unknowns and sums up what the innovations say about them.
class ParameterDerivatives {
 public:
  explicit ParameterDerivatives(const Unknowns& unknowns) : u_(unknowns) {
    jacobian_.setZero();
    jacobian_.block<3, 3>(0, kStartX).setIdentity();
  }

  void predict(const Prediction& step) {
    const Arc& arc = step.arc;
    jacobian_.row(0) += step.transition(0, 2) * jacobian_.row(2);
    jacobian_.row(1) += step.transition(1, 2) * jacobian_.row(2);
    jacobian_.col(kCLeft) += step.left_m * arc.jacobian_left;
    jacobian_.col(kCRight) += step.right_m * arc.jacobian_right;
    const Vector3d by_wheelbase = arc.turn_rad * arc.jacobian_turn;  // relative, with the sign reversed
    jacobian_.col(kB) -= by_wheelbase / u_[kB];
    if (step.motion == Motion::arc) jacobian_.col(kArcWheelbase) -= by_wheelbase;
    const Vector3d to = velocity(step.wheels_to, arc), from = velocity(step.wheels_from, arc);
    jacobian_.col(kClockOffset) += to - from;
    jacobian_.col(kSkew) += step.to.jacobian_skew_s * to - step.from.jacobian_skew_s * from;
  }

  template <int N>
  void update(const Update<N>& step, const BodySample&, Motion motion) {
    Eigen::Matrix<double, N, kUnknowns> jacobian = step.jacobian_state * jacobian_;
    jacobian.template block<N, 3>(0, kLeverX) += step.jacobian_lever;
    sums.cost += std::log(step.expected_covariance.determinant());
    sums.cost += step.loss.cost;
    count(step, motion);
    const Eigen::Matrix<double, kUnknowns, N> weighted = jacobian.transpose() * step.weight;
    sums.information.noalias() += weighted * jacobian;
    sums.gradient.noalias() += weighted * step.innovation;
    jacobian_.noalias() -= step.gain * jacobian;
  }

  InnovationSums sums;

 private:
  /// Velocity of the state at an end of the arc: its derivative by the time of that end.
  Vector3d velocity(const WheelState& wheels, const Arc& arc) const {
    return u_[kCLeft] * wheels.left_mps * arc.jacobian_left +
           u_[kCRight] * wheels.right_mps * arc.jacobian_right;
  }

  template <int N>
  void count(const Update<N>& step, Motion motion) {
    const auto& r = step.innovation;
    sums.chi_square += step.chi_square;
    sums.degrees_of_freedom += N;
    MotionTotals& totals = sums.motion[static_cast<std::size_t>(motion)];
    ++totals.samples;
    totals.sum_xy_m2 += r[0] * r[0] + r[1] * r[1];
    if constexpr (N == 3) totals.sum_theta_rad2 += r[2] * r[2];
    totals.chi_square += step.chi_square;
  }

  const Unknowns& u_;
  Eigen::Matrix<double, 3, kUnknowns> jacobian_;
};

/// Keeps each innovation in the robot's frame, divided by the Cholesky factor of its covariance.
class Standardiser {
 public:
  void predict(const Prediction&) {}

  template <int N>
  void update(const Update<N>& step, const BodySample&, Motion) {
    typename Update<N>::Square to_robot = Update<N>::Square::Identity();
    const double c = std::cos(step.heading_rad), s = std::sin(step.heading_rad);
    to_robot.template topLeftCorner<2, 2>() << c, s, -s, c;
    const typename Update<N>::Square turned = to_robot * step.covariance * to_robot.transpose();
    Vector3d standard = Vector3d::Zero();
    standard.head<N>() = turned.llt().matrixL().solve(to_robot * step.innovation);
    innovations.push_back(standard);
  }

  std::vector<Vector3d> innovations;
};

}  // namespace

InnovationSums mean_of(std::span<const InnovationSums> passes) {
  InnovationSums mean;
  const auto count = static_cast<double>(passes.size());
  double freedom = 0;
  std::array<double, 4> samples{};
  for (const InnovationSums& pass : passes) {
    mean.information += pass.information / count;
    mean.gradient += pass.gradient / count;
    mean.cost += pass.cost / count;
    mean.chi_square += pass.chi_square / count;
    freedom += pass.degrees_of_freedom / count;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      samples[i] += pass.motion[i].samples / count;
      mean.motion[i].sum_xy_m2 += pass.motion[i].sum_xy_m2 / count;
      mean.motion[i].sum_theta_rad2 += pass.motion[i].sum_theta_rad2 / count;
      mean.motion[i].chi_square += pass.motion[i].chi_square / count;
    }
  }
  mean.degrees_of_freedom = static_cast<int>(std::lround(freedom));
  for (std::size_t i = 0; i < samples.size(); ++i)
    mean.motion[i].samples = static_cast<int>(std::lround(samples[i]));
  return mean;
}

InnovationSums innovations(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise,
                           RobustMode robust, const SampleSelection& samples) {
  ParameterDerivatives derivatives(unknowns);
  KalmanFilter filter(run, unknowns, noise, robust, TruthUse::values, derivatives);
  filter_run(run, unknowns, samples, filter);
  return derivatives.sums;
}

std::vector<Vector3d> standardised_innovations(const PreparedRun& run, const Unknowns& unknowns,
                                               const NoiseModel& noise, RobustMode robust,
                                               const SampleSelection& samples) {
  Standardiser standardiser;
  KalmanFilter filter(run, unknowns, noise, robust, TruthUse::values, standardiser);
  filter_run(run, unknowns, samples, filter);
  return std::move(standardiser.innovations);
}

Information expected_information(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise) {
  ParameterDerivatives derivatives(unknowns);
  KalmanFilter filter(run, unknowns, noise, RobustMode::none, TruthUse::times, derivatives);
  filter_run(run, unknowns, {}, filter);
  return derivatives.sums.information;
}

}  // namespace astro::calibration
