#include "host/calibration/likelihood/innovation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "host/calibration/likelihood/kalman_filter.hpp"

namespace astro::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Propagates the Jacobian of the state by the unknowns and sums up what the innovations say about them.
class ParameterDerivatives final : public Accumulator {
 public:
  explicit ParameterDerivatives(const Unknowns& unknowns) : u_(unknowns) {
    jacobian_.setZero();
    jacobian_.block<3, 3>(0, kStartX).setIdentity();
  }

  void predict(const Prediction& step) override {
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

  void update(const Update& step, Motion motion) override {
    Eigen::Matrix<double, 3, kUnknowns> jacobian = step.jacobian_state * jacobian_;
    jacobian.block<3, 3>(0, kLeverX) += step.jacobian_lever;
    sums.cost += std::log(step.expected_covariance.determinant());
    sums.cost += step.loss.cost;
    count(step, motion);
    const Eigen::Matrix<double, kUnknowns, 3> weighted = jacobian.transpose() * step.weight;
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

  void count(const Update& step, Motion motion) {
    const auto& r = step.innovation;
    sums.chi_square += step.chi_square;
    sums.degrees_of_freedom += step.components();
    MotionTotals& totals = sums.motion[static_cast<std::size_t>(motion)];
    ++totals.samples;
    totals.sum_xy_m2 += r[0] * r[0] + r[1] * r[1];
    totals.sum_theta_rad2 += r[2] * r[2];
    totals.chi_square += step.chi_square;
  }

  const Unknowns& u_;
  Eigen::Matrix<double, 3, kUnknowns> jacobian_;
};

/// Keeps each innovation in the robot's frame, divided by the Cholesky factor of its covariance.
class Standardiser final : public Accumulator {
 public:
  void predict(const Prediction&) override {}
  void update(const Update& step, Motion) override {
    const double c = std::cos(step.heading_rad), s = std::sin(step.heading_rad);
    Matrix3d to_robot;
    to_robot << c, s, 0, -s, c, 0, 0, 0, 1;
    const Matrix3d turned = to_robot * step.covariance * to_robot.transpose();
    innovations.push_back(turned.llt().matrixL().solve(to_robot * step.innovation));
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
  filter_run(run, unknowns, noise, robust, TruthUse::values, samples, derivatives);
  return derivatives.sums;
}

std::vector<Vector3d> standardised_innovations(const PreparedRun& run, const Unknowns& unknowns,
                                               const NoiseModel& noise, RobustMode robust,
                                               const SampleSelection& samples) {
  Standardiser standardiser;
  filter_run(run, unknowns, noise, robust, TruthUse::values, samples, standardiser);
  return std::move(standardiser.innovations);
}

Information expected_information(const PreparedRun& run, const Unknowns& unknowns, const NoiseModel& noise) {
  ParameterDerivatives derivatives(unknowns);
  filter_run(run, unknowns, noise, RobustMode::none, TruthUse::times, {}, derivatives);
  return derivatives.sums.information;
}

}  // namespace astro::calibration
