#include "host/calibration/likelihood/day_drift.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace astro::calibration {
namespace {

// The defaults count like this many days.
constexpr double kPriorDays = 4;
// A day that does not know a ratio to this part says nothing of a drift that is far less.
constexpr double kSaysNothing = 0.01;
constexpr double kNight_s = 6 * 3600;

std::vector<Pool> pools_of_days(std::span<const InnovationSums> drives, std::span<const int> days,
                                const FixedParameters& fixed, const PriorOfE& prior) {
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const auto day = static_cast<std::size_t>(days[i]);
    if (pools.size() <= day) pools.resize(day + 1, Pool(fixed, prior));
    pools[day].add(reduced(drives[i], fixed, 0));
  }
  return pools;
}

/// One value of each day, with the variance that noise gives it.
struct Value {
  double value = 0, variance = 0;
};

/// The standard deviation of the difference between two days. The variance between days takes one step of Fisher's scoring of the
/// restricted likelihood from the usual one, which gives the posterior mean where noise is nothing beside it.
double between_two_days(const std::vector<Value>& days, double usual_difference) {
  if (days.size() < 2) return usual_difference;
  // A day is off the mean of all days by half the variance of the difference between two.
  const double usual = usual_difference * usual_difference / 2;
  double weights = 0, squares = 0, sum = 0;
  for (const Value& day : days) {
    const double weight = 1 / (day.variance + usual);
    weights += weight;
    squares += weight * weight;
    sum += weight * day.value;
  }
  double slope = 0;
  for (const Value& day : days) {
    const double weight = 1 / (day.variance + usual);
    slope += std::pow(weight * (day.value - sum / weights), 2) - weight * (1 - weight / weights);
  }
  const auto count = static_cast<double>(days.size());
  const double curvature = squares * (count - 1) / count + kPriorDays / (usual * usual);
  return std::sqrt(2 * std::max(0.0, usual + slope / curvature));
}

}  // namespace

FactorMatrix ratios_by_factors(const WheelFactors& f) {
  const double both = f.c_r + f.c_l;
  FactorMatrix jacobian;
  jacobian << 1 / f.c_r, -1 / f.c_l, 0, 0,  //
      1 / both, 1 / both, 0, 0,             //
      -1 / both, -1 / both, 1 / f.b_m, 0,   //
      0, 0, 0, 1;
  return jacobian;
}

FactorMatrix DayDrift::covariance(const WheelFactors& f) const {
  // ln c_R = ln S + ln E_d / 2, ln c_L = ln S - ln E_d / 2, ln b = ln (b / S) + ln S, to first order.
  FactorMatrix jacobian;
  jacobian << f.c_r / 2, f.c_r, 0, 0,  //
      -f.c_l / 2, f.c_l, 0, 0,         //
      0, f.b_m, f.b_m, 0,              //
      0, 0, 0, 1;
  const FactorVector variances(E_d * E_d, scale * scale, b_over_scale * b_over_scale, e * e);
  return jacobian * variances.asDiagonal() * jacobian.transpose();
}

std::vector<int> find_days(std::span<const PreparedRun> runs) {
  std::vector<int> days(runs.size(), 0);
  const auto started = [&](std::size_t run) { return runs[run].source->started_s; };
  std::vector<std::size_t> order(runs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!std::ranges::all_of(order, [&](std::size_t run) { return started(run).has_value(); })) return days;
  std::ranges::sort(order, {}, started);
  for (std::size_t i = 1; i < order.size(); ++i)
    days[order[i]] = days[order[i - 1]] + (*started(order[i]) - *started(order[i - 1]) > kNight_s ? 1 : 0);
  return days;
}

DayDrift drift_between_days(std::span<const InnovationSums> drives, std::span<const int> days,
                            const FixedParameters& fixed, const PriorOfE& prior,
                            const WheelFactors& factors) {
  DayDrift drift;
  const Eigen::Matrix<double, 3, kFactors> jacobian = ratios_by_factors(factors).topRows<3>();
  std::array<std::vector<Value>, 3> values;
  for (const Pool& day : pools_of_days(drives, days, fixed, prior)) {
    const Eigen::Vector3d off = jacobian * day.factor_step();
    const Eigen::Matrix3d covariance = jacobian * day.factor_covariance() * jacobian.transpose();
    if (!(covariance.diagonal().maxCoeff() < kSaysNothing * kSaysNothing)) continue;
    ++drift.days;
    for (int i = 0; i < 3; ++i) values[static_cast<std::size_t>(i)].push_back({off[i], covariance(i, i)});
  }
  drift.E_d = between_two_days(values[0], drift.E_d);
  drift.scale = between_two_days(values[1], drift.scale);
  drift.b_over_scale = between_two_days(values[2], drift.b_over_scale);
  return drift;
}

FactorMatrix covariance_on_another_day(std::span<const InnovationSums> drives, std::span<const int> days,
                                       const FixedParameters& fixed, const PriorOfE& prior,
                                       const WheelFactors& factors, const FactorMatrix& own,
                                       const DayDrift& drift) {
  FactorMatrix of_a_day = drift.covariance(factors) / 2;
  if (fixed.e) of_a_day(kE, kE) = 0;
  const FactorMatrix inverse = pool_of(drives, fixed, prior).factor_covariance();
  FactorMatrix sum = own + of_a_day;
  // The drives' factors are a mean of the days', each weighted by its information. The prior has none of it.
  for (const Pool& day : pools_of_days(drives, days, fixed, PriorOfE{prior.e, 0})) {
    const FactorMatrix weight = inverse * day.information();
    sum += weight * of_a_day * weight.transpose();
  }
  return sum;
}

}  // namespace astro::calibration
