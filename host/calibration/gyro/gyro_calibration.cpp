#include "host/calibration/gyro/gyro_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/order_statistics.hpp"
#include "host/calibration/gyro/gyro_slips.hpp"

namespace astro::calibration {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;
// A FXAS21002C's angle random walk and the walk of its bias, in squares; what other sensors have is within the deviations.
constexpr double kGyro_rad2ps = 0.025 * 0.025 * kDegree_rad * kDegree_rad,
                 kBias_rad2ps3 = 0.001 * 0.001 * kDegree_rad * kDegree_rad;
// The logarithm of a variance that is known to a factor of twenty, and of the bias's walk, of which a drive shows little.
// What was measured at rest is right to a third: a drive has a hundred tenths of a second of rest.
constexpr double kRoughly = 3, kWalkRoughly = 1, kMeasured = 0.3;
constexpr double kWheelsDiffer = 0.01;  // that one wheel is larger than the factors say, relatively
constexpr double kRateDoubt_s = 1;      // what is known of the clocks beforehand: nothing
constexpr double kSpacing_s = 0.1, kLongestRest_s = 5;
constexpr std::size_t kMostSamples = 40'000, kFewestSamples = 20;

/// Wheels and gyro of a drive.
struct Pair {
  std::size_t drive = 0;
  std::vector<WheelTurn> wheels;
  GyroPath gyro;
  double steady_radps = 0;  // the rate is steady where it changes by less
};

/// Samples are compared where the robot's yaw rate is steady. There an error of the lag is a step of the phase, which the regressor of
/// the rate takes exactly, and neither the smoothing of a sensor nor the time between samples counts. Of a drive that never turns
/// steadily, the steadiest tenth of its turns counts.
double steady_limit(const std::vector<WheelTurn>& wheels) {
  constexpr double kSteady_radps = 0.05, kTurns_radps = 0.1;
  std::vector<double> changes;
  for (const WheelTurn& turn : wheels)
    if (std::abs(turn.rate_radps) > kTurns_radps) changes.push_back(turn.change_radps);
  if (changes.empty()) return kSteady_radps;
  const std::size_t rank = changes.size() / 10;
  return std::max(kSteady_radps, at_rank(std::move(changes), rank));
}

std::vector<Pair> pairs_of(std::span<const GyroDrive> drives, const WheelFactors& factors) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < drives.size(); ++i)
    if (drives[i].rates.size() >= kFewestSamples && drives[i].wheels.size() >= kFewestSamples)
      pairs.push_back({i, wheel_turns(drives[i].wheels, factors), GyroPath(drives[i].rates)});
  for (Pair& pair : pairs) pair.steady_radps = steady_limit(pair.wheels);
  return pairs;
}

/// How alike the gyro's rate and the wheels' are if the gyro lags by each of these many steps; the lag of the largest correlation.
class LagSearch {
 public:
  void take(const Pair& pair) {
    const double first_s = pair.wheels.front().time_s, last_s = pair.wheels.back().time_s;
    const auto steps = static_cast<std::ptrdiff_t>((last_s - first_s) / kStep_s);
    std::vector<double> wheels, gyro;  // rates on a grid; NaN where a gyro says nothing
    std::size_t at = 0;
    for (std::ptrdiff_t k = 0; k < steps; ++k) {
      const double time_s = first_s + static_cast<double>(k) * kStep_s;
      while (at + 1 < pair.wheels.size() && pair.wheels[at].time_s < time_s) ++at;
      wheels.push_back(pair.wheels[at].rate_radps);
      const auto from = pair.gyro.at(time_s - kStep_s), to = pair.gyro.at(time_s + kStep_s);
      gyro.push_back(from.known && to.known && from.piece == to.piece
                         ? (to.turn_rad - from.turn_rad) / (2 * kStep_s)
                         : std::nan(""));
    }
    for (std::ptrdiff_t lag = kFirst; lag <= kLast; ++lag)
      for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, -lag); k < steps && k + lag < steps; ++k) {
        const double w = wheels[static_cast<std::size_t>(k)], g = gyro[static_cast<std::size_t>(k + lag)];
        if (!std::isnan(g)) sums_[static_cast<std::size_t>(lag - kFirst)].add(w, g);
      }
  }

  std::pair<double, double> lag_s_and_correlation() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < kLags; ++i)
      if (std::abs(sums_[i].correlation()) > std::abs(sums_[best].correlation())) best = i;
    return {static_cast<double>(static_cast<std::ptrdiff_t>(best) + kFirst) * kStep_s,
            sums_[best].correlation()};
  }

 private:
  static constexpr double kStep_s = 0.02;
  static constexpr std::ptrdiff_t kFirst = -15, kLast = 30;
  static constexpr std::size_t kLags = kLast - kFirst + 1;
  struct Sums {
    double n = 0, w = 0, g = 0, ww = 0, gg = 0, wg = 0;
    void add(double wheels, double gyro) {
      n += 1;
      w += wheels;
      g += gyro;
      ww += wheels * wheels;
      gg += gyro * gyro;
      wg += wheels * gyro;
    }
    double correlation() const {
      const double spreads = (n * ww - w * w) * (n * gg - g * g);
      return spreads > 0 ? (n * wg - w * g) / std::sqrt(spreads) : 0;
    }
  };
  std::array<Sums, kLags> sums_{};
};

/// The variance of the gyro's noise per second by its mean rates over tenths of a second while the wheels rest; nothing with too few.
std::optional<double> noise_at_rest(const std::vector<Pair>& pairs) {
  constexpr double kBlock_s = 0.1, kBeginning_s = 0.2;  // in which the body still rocks
  constexpr std::size_t kFewestBlocks = 50;
  std::vector<double> differences;
  for (const Pair& pair : pairs) {
    double before_rad = std::nan("");
    double rests_since_s = pair.wheels.front().time_s, block_s = rests_since_s;
    for (std::size_t i = 1; i < pair.wheels.size(); ++i) {
      const double time_s = pair.wheels[i].time_s;
      if (pair.wheels[i].path_m != pair.wheels[i - 1].path_m) {
        rests_since_s = block_s = time_s;
        before_rad = std::nan("");
      }
      if (time_s < rests_since_s + kBeginning_s) block_s = time_s;
      if (time_s < block_s + kBlock_s) continue;
      const GyroPath::Place from = pair.gyro.at(block_s), to = pair.gyro.at(block_s + kBlock_s);
      if (!from.known || !to.known || from.piece != to.piece) break;
      if (!std::isnan(before_rad)) differences.push_back(to.turn_rad - from.turn_rad - before_rad);
      before_rad = to.turn_rad - from.turn_rad;
      block_s = time_s;
    }
  }
  if (differences.size() < kFewestBlocks) return std::nullopt;
  const double deviation_rad = deviation_of(std::move(differences));
  return deviation_rad * deviation_rad / (2 * kBlock_s);
}

/// Samples where the wheels turned, and both ends of each rest, in whose rounding to counts more samples would see noise.
std::vector<TurnSample> samples_against_wheels(const Pair& pair, double lag_s, double spacing_s) {
  std::vector<TurnSample> samples;
  int piece = 0;
  bool lost = false;
  const WheelTurn* used = nullptr;
  for (std::size_t i = 0; i < pair.wheels.size(); ++i) {
    const WheelTurn& now = pair.wheels[i];
    if (now.change_radps > pair.steady_radps) continue;
    if (used != nullptr) {
      const double since_s = now.time_s - used->time_s;
      const bool rests = now.path_m == used->path_m;
      const bool goes_on = i + 1 < pair.wheels.size() && pair.wheels[i + 1].path_m == now.path_m;
      if (since_s < spacing_s || (rests && goes_on && since_s < kLongestRest_s)) continue;
    }
    const GyroPath::Place gyro = pair.gyro.at(now.time_s + lag_s);
    if (!gyro.known) {
      lost = true;
      continue;
    }
    samples.push_back({now.time_s,
                       gyro.turn_rad,
                       {now.pose.theta_rad, now.rate_radps, now.way_m},
                       now.path_m,
                       used != nullptr && (lost || gyro.piece != piece)});
    piece = gyro.piece;
    lost = false;
    used = &now;
  }
  return samples;
}

/// The truth's headings, made continuous, and what the gyro says at the same times.
std::vector<TurnSample> samples_against_truth(const GyroDrive& drive, const Pair& pair, double lag_s,
                                              std::size_t stride) {
  std::vector<TurnSample> samples;
  int piece = 0;
  std::size_t at = 0;
  double heading_rad = std::nan("");
  for (std::size_t k = 0; k < drive.truth.size(); k += stride) {
    const BodySample& body = drive.truth[k];
    if (!std::isfinite(body.theta_rad)) continue;
    heading_rad =
        std::isnan(heading_rad) ? body.theta_rad : heading_rad + wrapped_rad(body.theta_rad - heading_rad);
    const GyroPath::Place gyro = pair.gyro.at(body.time_s + lag_s);
    if (!gyro.known) continue;
    while (at + 1 < pair.wheels.size() && pair.wheels[at].time_s < body.time_s) ++at;
    if (pair.wheels[at].change_radps > pair.steady_radps) continue;
    samples.push_back({body.time_s,
                       heading_rad,
                       {gyro.turn_rad, pair.wheels[at].rate_radps, 0},
                       pair.wheels[at].path_m,
                       !samples.empty() && gyro.piece != piece});
    piece = gyro.piece;
  }
  return samples;
}

TurnVector information(double way_deviation) {
  return {0, 1 / (kRateDoubt_s * kRateDoubt_s), 1 / (way_deviation * way_deviation)};
}

/// By the reference: a gyro on another axis turns nowhere.
double turned_rad(std::span<const std::vector<TurnSample>> drives) {
  double sum_rad = 0;
  for (const std::vector<TurnSample>& drive : drives)
    for (std::size_t i = 1; i < drive.size(); ++i)
      sum_rad += std::abs(drive[i].regressors[kTurn] - drive[i - 1].regressors[kTurn]);
  return sum_rad;
}

std::size_t count_of(std::span<const std::vector<TurnSample>> drives) {
  std::size_t count = 0;
  for (const std::vector<TurnSample>& drive : drives) count += drive.size();
  return count;
}

double spacing_for(const std::vector<Pair>& pairs) {
  double span_s = 0;
  for (const Pair& pair : pairs) span_s += pair.wheels.back().time_s - pair.wheels.front().time_s;
  return std::max(kSpacing_s, span_s / static_cast<double>(kMostSamples));
}

}  // namespace

GyroAgainstWheels compare_gyro(std::span<const GyroDrive> drives, const WheelFactors& factors) {
  constexpr double kLeastTurn_rad = 3, kLeastAlike = 0.5, kSettled_s = 1e-5;
  constexpr int kMostSteps = 6;
  const std::vector<Pair> pairs = pairs_of(drives, factors);
  LagSearch search;
  for (const Pair& pair : pairs) search.take(pair);
  const auto [first_lag_s, alike] = search.lag_s_and_correlation();
  GyroAgainstWheels found;
  found.lag_s = first_lag_s;
  const double spacing_s = spacing_for(pairs);
  std::vector<std::vector<TurnSample>> samples;
  const auto sampled = [&] {
    samples.clear();
    for (const Pair& pair : pairs) samples.push_back(samples_against_wheels(pair, found.lag_s, spacing_s));
  };
  sampled();
  if (count_of(samples) < kFewestSamples)
    throw Error("no drive has the rates of a gyro beside its wheels", GyroProblem::no_rates);
  if (turned_rad(samples) < kLeastTurn_rad)
    throw Error("the drives hardly turn, and without turns a gyro shows nothing but its bias",
                GyroProblem::no_turns);
  if (std::abs(alike) < kLeastAlike)
    throw Error(
        "the gyro does not turn as the wheels do: it is that of another robot, or its axis is not the one "
        "that points up",
        GyroProblem::nothing_alike);
  double count_m = 0;
  for (const GyroDrive& drive : drives) count_m = std::max(count_m, drive.count_m);
  // The rounding of both wheels, each uniform; and 0.1 mrad, so that simulated wheels without counts have some.
  const double rounding_rad2 = 1e-8 + count_m * count_m / (6 * factors.b_m * factors.b_m);
  const std::optional<double> at_rest = noise_at_rest(pairs);
  const TurnNoisePrior prior{{at_rest.value_or(kGyro_rad2ps), kBias_rad2ps3,
                              NoiseModel().K_m / (factors.b_m * factors.b_m), rounding_rad2},
                             {at_rest ? kMeasured : kRoughly, kWalkRoughly, kRoughly, 0}};
  TurnRegression fit;
  for (int step = 0; step < kMostSteps; ++step) {
    if (step > 0) sampled();
    fit = regress_turns(samples, information(kWheelsDiffer * 2 / factors.b_m), prior);
    const double late_s = -fit.x[kRate] / fit.x[kTurn];
    found.lag_s += late_s;
    if (std::abs(late_s) < kSettled_s) break;
  }
  const double product = fit.x[kTurn];
  found.product = product;
  found.product_se = std::sqrt(fit.covariance(kTurn, kTurn));
  found.difference = fit.x[kWay] * factors.b_m / product;
  found.difference_se = std::sqrt(fit.covariance(kWay, kWay)) * factors.b_m / std::abs(product);
  found.lag_se_s = std::sqrt(fit.covariance(kRate, kRate)) / std::abs(product);
  found.noise = fit.noise;
  found.chi_square = fit.chi_square;
  found.degrees_of_freedom = fit.degrees_of_freedom;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const GyroDrive& drive = drives[pairs[i].drive];
    found.biases.push_back({drive.name, fit.drifts[i].radps, fit.drifts[i].se_radps});
    const GyroFollowing following{product,
                                  found.lag_s,
                                  std::max(0.002, 3 * found.lag_se_s),
                                  -fit.drifts[i].radps / product,
                                  -fit.x[kWay] / product,
                                  fit.noise};
    for (UnseenTurn& slip : unseen_turns(pairs[i].wheels, pairs[i].gyro, following)) {
      slip.drive = pairs[i].drive;
      found.slips.push_back(slip);
    }
  }
  return found;
}

std::optional<GyroScale> gyro_scale_by_truth(std::span<const GyroDrive> drives, const WheelFactors& factors,
                                             const GyroAgainstWheels& compared) {
  // A tracker's heading is right to 0.15 degrees, as that of the reference experiment.
  constexpr double kTruth_rad = 0.15 * kDegree_rad;
  std::size_t all = 0;
  for (const GyroDrive& drive : drives) all += drive.truth.size();
  std::vector<std::vector<TurnSample>> samples;
  for (const Pair& pair : pairs_of(drives, factors)) {
    samples.push_back(
        samples_against_truth(drives[pair.drive], pair, compared.lag_s, all / kMostSamples + 1));
    if (samples.back().empty()) samples.pop_back();
  }
  if (count_of(samples) < kFewestSamples) return std::nullopt;
  const TurnNoisePrior prior{{compared.noise.gyro_rad2ps, kBias_rad2ps3, 0, kTruth_rad * kTruth_rad},
                             {kMeasured, kWalkRoughly, 0, kRoughly}};
  const TurnRegression fit = regress_turns(samples, information(1), prior);
  const double scale = 1 / fit.x[kTurn];
  return GyroScale{scale, std::sqrt(fit.covariance(kTurn, kTurn)) * scale * scale, fit.chi_square,
                   fit.degrees_of_freedom};
}

std::optional<GyroByHeadings> gyro_scale_by_headings(std::span<const GyroDrive> drives,
                                                     std::span<const std::vector<KnownHeading>> headings,
                                                     double heading_rad, const GyroAgainstWheels& compared) {
  constexpr double kWithinTwo = 1.4, kLeastTurn_rad = 2 * std::numbers::pi - 0.5;
  std::vector<std::vector<TurnSample>> samples;
  std::vector<std::string> names;
  double turned_rad = 0;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const GyroPath gyro(drives[i].rates);
    std::vector<TurnSample> of_drive;
    int piece = 0;
    for (const KnownHeading& known : headings[i]) {
      const GyroPath::Place place = gyro.at(known.time_s);
      if (!place.known) continue;
      const bool goes_on = !of_drive.empty() && place.piece == piece;
      if (goes_on) turned_rad += std::abs(known.heading_rad - of_drive.back().regressors[kTurn]);
      of_drive.push_back(
          {known.time_s, place.turn_rad, {known.heading_rad, 0, 0}, 0, !of_drive.empty() && !goes_on});
      piece = place.piece;
    }
    if (of_drive.size() < 2) continue;
    samples.push_back(std::move(of_drive));
    names.push_back(drives[i].name);
  }
  if (turned_rad < kLeastTurn_rad) return std::nullopt;
  const double scale = compared.product;
  const TurnNoisePrior prior{
      {compared.noise.gyro_rad2ps, kBias_rad2ps3, 0, scale * scale * heading_rad * heading_rad},
      {kMeasured, kWalkRoughly, 0, kWithinTwo}};
  // Rate and way have no part in this. Any information keeps their coefficients at zero.
  const TurnRegression fit = regress_turns(samples, {0, 1, 1}, prior);
  // regress_turns counts three coefficients. Here there are the scale, and for each drive the bias.
  const int free = fit.degrees_of_freedom + kTurnColumns - 1 - static_cast<int>(samples.size());
  GyroByHeadings found{{fit.x[kTurn], std::sqrt(fit.covariance(kTurn, kTurn)), fit.chi_square, free}, {}};
  for (std::size_t i = 0; i < names.size(); ++i)
    found.biases.push_back({names[i], fit.drifts[i].radps, fit.drifts[i].se_radps});
  return found;
}

}  // namespace astro::calibration
