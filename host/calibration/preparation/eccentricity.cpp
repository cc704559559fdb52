#include "host/calibration/preparation/eccentricity.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "host/calibration/motion/wheel_path.hpp"
#include "host/calibration/preparation/path_alignment.hpp"

namespace astro::calibration {
namespace {

constexpr double kOnce = 1;
// The waves per turn that are compared with it. Those of gears (1/2, 2) and, near 1, of a wheel of another
// size are left out.
constexpr std::array kPerTurn{0.6, 0.7, 0.8, 1.25, 1.4, 1.6};
constexpr double kFewestTurns = 10;
constexpr double kShown = 4;  // standard errors

/// A pair of samples half a turn of the wheels apart.
struct Pair {
  double gained_rad = 0;               // what truth turned more than the wheels
  std::array<double, 2> from_m, to_m;  // readings, left and right
};

/// The headings by which truth is ahead of the wheels, without jumps by whole turns.
std::vector<double> gains_rad(const PreparedRun& run, const ClockFit& clock, const WheelFactors& factors) {
  const std::vector<BodySample> odometry = dead_reckoned(run, clock, factors);
  std::vector<double> gains;
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    const double gain = run.truth[i].theta_rad - odometry[i].theta_rad;
    gains.push_back(gains.empty() ? gain
                                  : gains.back() + std::remainder(gain - gains.back(), 2 * std::numbers::pi));
  }
  return gains;
}

std::vector<Pair> pairs_of(const PreparedRun& run, const ClockFit& clock, const WheelFactors& factors) {
  const double half_turn_m = run.source->wheel_turn_m / 2;
  const std::vector<double> gains = gains_rad(run, clock, factors);
  const WheelPath path(run.source->wheels);
  std::vector<std::array<double, 2>> readings;
  for (const BodySample& sample : run.truth) {
    const WheelState at = path.at(clock.robot_time_s(sample.time_s, run.clock_middle_s));
    readings.push_back({at.left_m, at.right_m});
  }
  std::vector<Pair> pairs;
  for (std::size_t from = 0, to = 0; from < readings.size(); ++from) {
    const auto travelled_m = [&] {
      return (readings[to][0] + readings[to][1] - readings[from][0] - readings[from][1]) / 2;
    };
    while (to + 1 < readings.size() && std::abs(travelled_m()) < half_turn_m) ++to;
    const double way_m = run.path_m[to] - run.path_m[from];
    // Skips pairs between which the robot spun or turned back, because its path is longer then, and pairs across a gap of
    // truth.
    if (std::abs(travelled_m()) < half_turn_m || way_m > 1.2 * half_turn_m) continue;
    pairs.push_back({gains[to] - gains[from], readings[from], readings[to]});
  }
  return pairs;
}

using Wave =
    Eigen::Vector4d;  // cosine and sine of the left wheel's travel, then of the right one's, in metres

struct WaveFit {
  Wave wave;
  Eigen::Matrix4d normal_inverse;  // its covariance for noise of variance 1
  double explained = 0;            // sum of the squares of the gains that it explains
};

std::optional<WaveFit> wave_of(const std::vector<Pair>& pairs, double per_turn, double turn_m,
                               const WheelFactors& factors) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Wave right_side = Wave::Zero();
  const double per_metre = 2 * std::numbers::pi * per_turn / turn_m;
  for (const Pair& pair : pairs) {
    Wave row;
    for (int wheel = 0; wheel < 2; ++wheel) {
      const auto at = static_cast<std::size_t>(wheel);
      const double from = per_metre * pair.from_m[at], to = per_metre * pair.to_m[at];
      row.segment<2>(2 * wheel) << std::cos(to) - std::cos(from), std::sin(to) - std::sin(from);
    }
    row.head<2>() *= -1;
    row /= factors.b_m;
    normal += row * row.transpose();
    right_side += row * pair.gained_rad;
  }
  const Eigen::LDLT<Eigen::Matrix4d> ldlt(normal);
  // On one long line both wheels turn alike, so their waves cannot be separated.
  const auto pivots = ldlt.vectorD().array();
  if (!(pivots.minCoeff() > 1e-3 * pivots.maxCoeff())) return {};
  const Wave wave = ldlt.solve(right_side);
  return WaveFit{wave, ldlt.solve(Eigen::Matrix4d::Identity()), wave.dot(right_side)};
}

/// The waves once per turn in one run, left and right, with the squares that noise alone would have there.
struct RunWaves {
  Wave wave;
  std::array<double, 2> noise_m2{};
};

/// The noise is that of the other waves. If a quarter turn of the robot is nearly whole turns of a wheel, both wheels lead and
/// lag alike on all sides of a square, but only with the wave once per turn, so this one is less certain than the others.
/// Therefore the squares that the others explain are also scaled by the covariance of the wave once per turn, and the larger
/// result counts.
std::optional<RunWaves> waves_of(const PreparedRun& run, const ClockFit& clock, const WheelFactors& factors) {
  const double turn_m = run.source->wheel_turn_m;
  if (!(turn_m > 0) || !run.has_headings || run.distance_m < kFewestTurns * turn_m) return {};
  const std::vector<Pair> pairs = pairs_of(run, clock, factors);
  const std::optional<WaveFit> once = wave_of(pairs, kOnce, turn_m, factors);
  if (!once) return {};
  double explained = 0;  // by each of the four numbers of a wave
  RunWaves out{once->wave};
  for (const double per_turn : kPerTurn) {
    const std::optional<WaveFit> other = wave_of(pairs, per_turn, turn_m, factors);
    if (!other) return {};
    explained += other->explained / 4 / static_cast<double>(kPerTurn.size());
    for (const int wheel : {0, 1})
      out.noise_m2[static_cast<std::size_t>(wheel)] +=
          other->wave.segment<2>(2 * wheel).squaredNorm() / static_cast<double>(kPerTurn.size());
  }
  for (const int wheel : {0, 1}) {
    double& noise_m2 = out.noise_m2[static_cast<std::size_t>(wheel)];
    noise_m2 = std::max(noise_m2, explained * once->normal_inverse.diagonal().segment<2>(2 * wheel).sum());
  }
  return out;
}

/// The mean over the runs, weighted by how well each shows the wheel.
Eccentricity of_wheel(const std::vector<RunWaves>& runs, int wheel) {
  Eccentricity out;
  double weights = 0, squares = 0, noise = 0, spread = 0;
  for (const RunWaves& run : runs) {
    const Eigen::Vector2d wave = run.wave.segment<2>(2 * wheel);
    const double noise_m2 = run.noise_m2[static_cast<std::size_t>(wheel)];
    const double weight = 1 / (noise_m2 * noise_m2);
    weights += weight;
    squares += weight * wave.squaredNorm();
    noise += weight * noise_m2;
    spread += weight * weight * noise_m2;
    out.phases_rad.push_back(std::atan2(wave[1], wave[0]));
  }
  // With noise alone, `squares` would be `noise`, and each of the two directions has half of it.
  out.amplitude_m = runs.empty() ? 0 : std::sqrt(std::max(0.0, squares - noise) / weights);
  out.standard_error_m =
      runs.empty() ? std::numeric_limits<double>::infinity() : std::sqrt(spread / 2) / weights;
  // With noise alone, the standard deviation of a square equals its mean, as for chi-square with two degrees
  // of freedom.
  out.significant =
      out.amplitude_m > kShown * out.standard_error_m && squares > noise + (kShown + 1) * std::sqrt(weights);
  return out;
}

}  // namespace

Eccentricities find_eccentricities(std::span<const PreparedRun> runs, std::span<const ClockFit> clocks,
                                   const WheelFactors& factors) {
  std::vector<RunWaves> found;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (const auto waves = waves_of(runs[i], clocks[i], factors)) found.push_back(*waves);
  return {of_wheel(found, 0), of_wheel(found, 1)};
}

}  // namespace astro::calibration
