#include "host/calibration/likelihood/innovation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "host/calibration/likelihood/kalman_filter.hpp"

namespace astro::calibration {
namespace {

/// One row of the Jacobian of the pose by all unknowns.
using Row = std::array<double, kUnknowns>;

/// Propagates the Jacobian of the state by the unknowns and sums up what the innovations say about them.
class ParameterDerivatives final : public Accumulator {
 public:
  ParameterDerivatives() { jacobian_[0][kStartX] = jacobian_[1][kStartY] = jacobian_[2][kStartTheta] = 1; }

  void predict(const Prediction& step) override {
    Row &x = jacobian_[0], &y = jacobian_[1];
    const Row& theta = jacobian_[2];
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      x[i] -= step.dy_m * theta[i];
      y[i] += step.dx_m * theta[i];
    }
    for (std::size_t i = 0; i < kMoveUnknowns.size(); ++i)
      add(kMoveUnknowns[i], step.turned(step.move.by[i]));
  }

  void update(const Update& step, Motion motion) override {
    const std::array<Row, 3> by = of_innovation(step);
    const Symmetric3& w = step.weight;
    const Vector3 weighted_innovation = product(w, step.innovation);
    std::array<Row, 3> weighted;
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      const Vector3 column = product(w, {by[0][i], by[1][i], by[2][i]});
      for (std::size_t k = 0; k < 3; ++k) weighted[k][i] = column[k];
      gradient_[i] += by[0][i] * weighted_innovation[0] + by[1][i] * weighted_innovation[1] +
                      by[2][i] * weighted_innovation[2];
    }
    for (std::size_t i = 0; i < kUnknowns; ++i)
      for (std::size_t k = i; k < kUnknowns; ++k)
        information_[i][k] +=
            by[0][i] * weighted[0][k] + by[1][i] * weighted[1][k] + by[2][i] * weighted[2][k];
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < kUnknowns; ++i)
        jacobian_[k][i] -=
            step.gain[k][0] * by[0][i] + step.gain[k][1] * by[1][i] + step.gain[k][2] * by[2][i];
    count(step, motion);
  }

  InnovationSums sums() const {
    InnovationSums out = sums_;
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      out.gradient[static_cast<Eigen::Index>(i)] = gradient_[i];
      for (std::size_t k = 0; k < kUnknowns; ++k)
        out.information(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
            information_[std::min(i, k)][std::max(i, k)];
    }
    return out;
  }

 private:
  void add(Unknown unknown, const Vector3& change) {
    for (std::size_t k = 0; k < 3; ++k) jacobian_[k][unknown] += change[k];
  }

  /// Derivatives of the measurement.
  std::array<Row, 3> of_innovation(const Update& step) const {
    std::array<Row, 3> by = jacobian_;
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      by[0][i] -= step.lever_y_m * jacobian_[2][i];
      by[1][i] += step.lever_x_m * jacobian_[2][i];
    }
    by[0][kLeverX] += step.cosine;
    by[0][kLeverY] -= step.sine;
    by[1][kLeverX] += step.sine;
    by[1][kLeverY] += step.cosine;
    if (step.has_heading)
      by[2][kLeverYaw] += 1;
    else
      by[2] = {};
    return by;
  }

  void count(const Update& step, Motion motion) {
    const Vector3& r = step.innovation;
    sums_.cost += std::log(determinant(step.expected_covariance)) + step.loss.cost;
    sums_.chi_square += step.chi_square;
    sums_.degrees_of_freedom += step.components();
    MotionTotals& totals = sums_.motion[static_cast<std::size_t>(motion)];
    ++totals.samples;
    totals.sum_xy_m2 += r[0] * r[0] + r[1] * r[1];
    totals.sum_theta_rad2 += r[2] * r[2];
    totals.chi_square += step.chi_square;
  }

  std::array<Row, 3> jacobian_{};
  std::array<Row, kUnknowns> information_{};  // above its diagonal
  Row gradient_{};
  InnovationSums sums_;
};

/// Keeps each innovation in the robot's frame, divided by the Cholesky factor of its covariance.
class Standardiser final : public Accumulator {
 public:
  void predict(const Prediction&) override {}
  void update(const Update& step, Motion) override {
    const double c = step.cosine, s = step.sine;
    const Vector3& r = step.innovation;
    const Vector3 turned{c * r[0] + s * r[1], c * r[1] - s * r[0], r[2]};
    const Vector3 unit = standardised(turned, rotated(step.covariance, c, -s));
    innovations.push_back({unit[0], unit[1], unit[2]});
  }

  std::vector<Eigen::Vector3d> innovations;
};

}  // namespace

InnovationSums mean_of(std::span<const InnovationSums> passes) {
  InnovationSums mean;
  mean.session = passes.front().session;
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

InnovationSums innovations(const Moves& moves, const NoiseModel& noise, RobustMode robust,
                           const SampleSelection& samples) {
  ParameterDerivatives derivatives;
  filter_run(moves, noise, robust, TruthUse::values, samples, derivatives);
  InnovationSums sums = derivatives.sums();
  sums.session = moves.run().session;
  return sums;
}

std::vector<Eigen::Vector3d> standardised_innovations(const Moves& moves, const NoiseModel& noise,
                                                      RobustMode robust, const SampleSelection& samples) {
  Standardiser standardiser;
  filter_run(moves, noise, robust, TruthUse::values, samples, standardiser);
  return std::move(standardiser.innovations);
}

Information expected_information(const Moves& moves, const NoiseModel& noise) {
  ParameterDerivatives derivatives;
  filter_run(moves, noise, RobustMode::none, TruthUse::times, {}, derivatives);
  return derivatives.sums().information;
}

}  // namespace astro::calibration
