#include "host/calibration/likelihood/innovation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>
#include <utility>

#include "host/calibration/likelihood/kalman_filter.hpp"

namespace astro::calibration {
namespace {

/// One row of the Jacobian of the pose by all unknowns.
using Row = Eigen::Array<double, kUnknowns, 1>;

/// The sum of the logarithms of many numbers, with one logarithm at the end.
class LogSum {
 public:
  /// Precondition: positive.
  void add(double factor) {
    int exponent = 0;
    product_ *= std::frexp(factor, &exponent);
    exponent_ += exponent;
    if (product_ > 0x1p-900) return;  // as long as another factor, of at least 1/2, fits
    product_ = std::frexp(product_, &exponent);
    exponent_ += exponent;
  }
  double value() const { return std::log(product_) + static_cast<double>(exponent_) * std::numbers::ln2; }

 private:
  double product_ = 1;
  std::int64_t exponent_ = 0;
};

/// Propagates the Jacobian of the state by the unknowns, and sums up the information of the innovations about
/// them.
class ParameterDerivatives final : public Accumulator {
 public:
  explicit ParameterDerivatives(int session) {
    sums_.session = session;
    for (Row& row : jacobian_) row.setZero();
    jacobian_[0][kStartX] = jacobian_[1][kStartY] = jacobian_[2][kStartTheta] = 1;
  }

  void predict(const Prediction& step) override {
    jacobian_[0] -= step.dy_m * jacobian_[2];
    jacobian_[1] += step.dx_m * jacobian_[2];
    for (std::size_t i = 0; i < kMoveUnknowns.size(); ++i)
      add(kMoveUnknowns[i], step.turned(step.move.by[i]));
  }

  void update(const Update& step, Motion motion) override {
    const std::array<Row, 3> by = of_innovation(step);
    const Symmetric3& w = step.weight;
    const Vector3 weighted_innovation = product(w, step.innovation);
    const std::array<Row, 3> weighted{w.xx * by[0] + w.xy * by[1] + w.xt * by[2],
                                      w.xy * by[0] + w.yy * by[1] + w.yt * by[2],
                                      w.xt * by[0] + w.yt * by[1] + w.tt * by[2]};
    gradient_ +=
        weighted_innovation[0] * by[0] + weighted_innovation[1] * by[1] + weighted_innovation[2] * by[2];
    add_information(by, weighted, std::make_index_sequence<kUnknowns>());
    for (std::size_t k = 0; k < 3; ++k)
      jacobian_[k] -= step.gain[k][0] * by[0] + step.gain[k][1] * by[1] + step.gain[k][2] * by[2];
    count(step, motion);
  }

  InnovationSums sums() const {
    InnovationSums out = sums_;
    out.cost = losses_ + logarithms_.value();
    out.gradient = gradient_;
    out.information = information_.selfadjointView<Eigen::Lower>();
    return out;
  }

 private:
  void add(Unknown unknown, const Vector3& change) {
    for (std::size_t k = 0; k < 3; ++k) jacobian_[k][unknown] += change[k];
  }

  /// Adds to what is on and below the diagonal, column by column; the sizes are known, so that the columns stay in registers.
  template <std::size_t... Column>
  void add_information(const std::array<Row, 3>& by, const std::array<Row, 3>& weighted,
                       std::index_sequence<Column...>) {
    const auto add_column = [&](auto column) {
      constexpr int kColumn = static_cast<int>(decltype(column)::value);
      constexpr int kRows = kUnknowns - kColumn / 2 * 2;  // an even number, for packets of two
      information_.col(kColumn).template tail<kRows>().array() +=
          by[0][kColumn] * weighted[0].template tail<kRows>() +
          by[1][kColumn] * weighted[1].template tail<kRows>() +
          by[2][kColumn] * weighted[2].template tail<kRows>();
    };
    (add_column(std::integral_constant<std::size_t, Column>()), ...);
  }

  /// Derivatives of the measurement.
  std::array<Row, 3> of_innovation(const Update& step) const {
    std::array<Row, 3> by{jacobian_[0] - step.lever_y_m * jacobian_[2],
                          jacobian_[1] + step.lever_x_m * jacobian_[2], jacobian_[2]};
    by[0][kLeverX] += step.cosine;
    by[0][kLeverY] -= step.sine;
    by[1][kLeverX] += step.sine;
    by[1][kLeverY] += step.cosine;
    if (step.has_heading)
      by[2][kLeverYaw] += 1;
    else
      by[2].setZero();
    return by;
  }

  void count(const Update& step, Motion motion) {
    const Vector3& r = step.innovation;
    logarithms_.add(determinant(step.expected_covariance));
    losses_ += step.loss.cost;
    sums_.chi_square += step.chi_square;
    sums_.degrees_of_freedom += step.components();
    MotionTotals& totals = sums_.motion[static_cast<std::size_t>(motion)];
    ++totals.samples;
    totals.sum_xy_m2 += r[0] * r[0] + r[1] * r[1];
    totals.sum_theta_rad2 += r[2] * r[2];
    totals.chi_square += step.chi_square;
  }

  std::array<Row, 3> jacobian_;
  Information information_ = Information::Zero();  // on and below its diagonal
  Row gradient_ = Row::Zero();
  LogSum logarithms_;
  double losses_ = 0;
  InnovationSums sums_;
};

/// Divides the sums among the stretches of a run.
class ByStretch final : public Accumulator {
 public:
  ByStretch(const PreparedRun& run, const SampleSelection& samples, int count)
      : sums_(static_cast<std::size_t>(count)), derivatives_(run.session) {
    const double length_m = run.path_m.back();
    for (std::size_t i = 0; i < run.truth.size(); ++i)
      if (samples.takes(run.knots_m, i))
        stretch_.push_back(length_m > 0 ? std::min(sums_.size() - 1,
                                                   static_cast<std::size_t>(run.path_m[i] / length_m * count))
                                        : 0);
    for (InnovationSums& stretch : sums_) stretch.session = run.session;
  }

  void predict(const Prediction& step) override { derivatives_.predict(step); }
  void update(const Update& step, Motion motion) override {
    const std::size_t stretch = stretch_[next_++];
    if (stretch != current_) finish();
    current_ = stretch;
    derivatives_.update(step, motion);
  }

  std::vector<InnovationSums> sums() {
    finish();
    return sums_;
  }
  InnovationSums of_whole_run() const { return derivatives_.sums(); }

 private:
  /// What was added since the last call belongs to the current stretch.
  void finish() {
    const InnovationSums now = derivatives_.sums();
    sums_[current_].information += now.information - before_.information;
    sums_[current_].gradient += now.gradient - before_.gradient;
    before_ = now;
  }

  std::vector<InnovationSums> sums_;
  std::vector<std::size_t> stretch_;  // of each truth sample that the filter takes
  std::size_t next_ = 0, current_ = 0;
  ParameterDerivatives derivatives_;
  InnovationSums before_;
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

template <class... Accumulators>
void run_filter(const Moves& moves, const NoiseModel& noise, RobustMode robust,
                const SampleSelection& samples, Accumulators&... accumulators) {
  const std::array<Accumulator*, sizeof...(Accumulators)> all{&accumulators...};
  filter_run(moves, noise, robust, TruthUse::values, samples, all);
}

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
  ParameterDerivatives derivatives(moves.run().session);
  run_filter(moves, noise, robust, samples, derivatives);
  return derivatives.sums();
}

std::pair<InnovationSums, NoiseSlope> innovations_and_noise(const Moves& moves, const NoiseModel& noise,
                                                            RobustMode robust,
                                                            const SampleSelection& samples) {
  ParameterDerivatives derivatives(moves.run().session);
  NoiseDerivatives by_noise(robust);
  run_filter(moves, noise, robust, samples, derivatives, by_noise);
  return {derivatives.sums(), by_noise.slope()};
}

NoisePass innovations_and_noise(const Moves& moves, const NoiseModel& noise, RobustMode robust,
                                const SampleSelection& samples, int stretches) {
  ByStretch by_stretch(moves.run(), samples, stretches);
  NoiseDerivatives by_noise(robust);
  run_filter(moves, noise, robust, samples, by_stretch, by_noise);
  return {by_stretch.of_whole_run(), by_stretch.sums(), by_noise.slope()};
}

std::vector<InnovationSums> innovations_by_stretch(const Moves& moves, const NoiseModel& noise,
                                                   RobustMode robust, const SampleSelection& samples,
                                                   int stretches) {
  ByStretch by_stretch(moves.run(), samples, stretches);
  run_filter(moves, noise, robust, samples, by_stretch);
  return by_stretch.sums();
}

std::vector<Eigen::Vector3d> standardised_innovations(const Moves& moves, const NoiseModel& noise,
                                                      RobustMode robust, const SampleSelection& samples) {
  Standardiser standardiser;
  run_filter(moves, noise, robust, samples, standardiser);
  return std::move(standardiser.innovations);
}

Information expected_information(const Moves& moves, const NoiseModel& noise,
                                 const SampleSelection& samples) {
  ParameterDerivatives derivatives(moves.run().session);
  Accumulator* const accumulator = &derivatives;
  filter_run(moves, noise, RobustMode::none, TruthUse::times, samples, {&accumulator, 1});
  return derivatives.sums().information;
}

}  // namespace astro::calibration
