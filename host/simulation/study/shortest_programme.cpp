#include "host/simulation/study/shortest_programme.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "host/base/error.hpp"
#include "host/simulation/study/limits.hpp"

namespace astro::simulation::study {
namespace {

using calibration::Precision;
using Eigen::Matrix3d;

// The search tries this many steps to either side, enough to exchange a square for lines.
constexpr int kReach = 5;
constexpr int kMostRounds = 20;
constexpr double kTargetMissed = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse_too_fine() {
  throw Error("a precision this fine takes more than " + std::to_string(kMostRuns) + " runs",
              {Help::drive_longer_runs_or_ask_less});
}

/// 1 if the target is just met, more if it is missed.
double excess(const Precision& reached, const Precision& target) {
  return std::max({reached.E_d / target.E_d, reached.scale / target.scale, reached.b / target.b});
}

/// What can be added to a programme at a time: a line, or a pair of turning runs.
struct Unit {
  Kind kind = kSquares;
  int runs = 1;
  double time_s = 0;
  Matrix3d information = Matrix3d::Zero();
};

Counts counts_of(const std::vector<Unit>& units, const std::vector<int>& numbers) {
  Counts counts{};
  for (std::size_t i = 0; i < units.size(); ++i) counts[units[i].kind] = numbers[i] * units[i].runs;
  return counts;
}

/// About c_R, c_L and b.
Matrix3d information_of(const Forecast& forecast) {
  return forecast.covariance.topLeftCorner<3, 3>().inverse();
}

/// Time and information of a unit are what it adds to a programme with one unit of every kind.
std::vector<Unit> units_of(const std::vector<Kind>& kinds, const Programme& sizes) {
  std::vector<Unit> units;
  for (const Kind kind : kinds) units.push_back({kind, kind == kLines ? 1 : 2});
  std::vector<int> numbers(units.size(), 1);
  const Forecast base = forecast(sizes.with(counts_of(units, numbers)));
  for (std::size_t i = 0; i < units.size(); ++i) {
    numbers[i] = 2;
    const Forecast more = forecast(sizes.with(counts_of(units, numbers)));
    numbers[i] = 1;
    units[i].time_s = more.driving_time_s - base.driving_time_s;
    units[i].information = information_of(more) - information_of(base);
  }
  return units;
}

/// Searches the numbers of units whose summed information meets the target.
class Search {
 public:
  Search(const std::vector<Unit>& units, const Precision& target, double wheelbase_m)
      : units_(units), target_(target), nominal_{1, 1, wheelbase_m} {}

  std::vector<int> best() {
    std::vector<int> numbers(units_.size(), 1);
    while (time_of(numbers) == kTargetMissed)
      for (int& number : numbers)
        if ((number *= 2) > kMostRuns) refuse_too_fine();
    for (int step = std::max(1, numbers.front() / 4); step >= 1; step /= 2)
      while (improve(numbers, step)) {
      }
    return numbers;
  }

 private:
  double time_of(const std::vector<int>& numbers) const {
    // A line adds a little information about b only beside turning runs, through the parameters that runs
    // share.
    if (why_undetermined(counts_of(units_, numbers))) return kTargetMissed;
    double time_s = 0;
    Matrix3d information = Matrix3d::Zero();
    for (std::size_t i = 0; i < units_.size(); ++i) {
      time_s += numbers[i] * units_[i].time_s;
      information += numbers[i] * units_[i].information;
    }
    const Matrix3d covariance = information.inverse();
    if (!covariance.allFinite() || !(covariance.diagonal().minCoeff() > 0)) return kTargetMissed;
    calibration::FactorCovariance all = calibration::FactorCovariance::Zero();
    all.topLeftCorner<3, 3>() = covariance;
    const calibration::MlErrors se = errors_of(all, nominal_);
    const bool met = excess({se.E_d, se.scale, se.b_m / nominal_.b_m}, target_) <= 1;
    return met ? time_s : kTargetMissed;
  }

  /// Moves to the best neighbouring programme; returns false if none is better.
  bool improve(std::vector<int>& numbers, int step) const {
    std::vector<int> trial = numbers, best = numbers;
    double least_s = time_of(numbers) * (1 - 1e-12);
    const auto look = [&](const auto& self, std::size_t i) -> void {
      if (i == units_.size()) {
        if (const double time_s = time_of(trial); time_s < least_s) {
          least_s = time_s;
          best = trial;
        }
        return;
      }
      for (int move = -kReach; move <= kReach; ++move) {
        trial[i] = numbers[i] + move * step;
        if (trial[i] >= 0) self(self, i + 1);
      }
    };
    look(look, 0);
    const bool better = best != numbers;
    numbers = best;
    return better;
  }

  const std::vector<Unit>& units_;
  Precision target_;
  calibration::WheelFactors nominal_;
};

}  // namespace

Forecast shortest_programme(const Precision& target, const std::vector<Kind>& kinds, const Programme& sizes) {
  require_positive(target.E_d, "the precision wanted of E_d");
  require_positive(target.scale, "the precision wanted of the scale");
  require_positive(target.b, "the precision wanted of the wheelbase");
  const std::vector<Unit> units = units_of(kinds, sizes);
  // All runs together may give a little less information than the sum of the units; then the sum has to meet
  // a slightly stricter target.
  double factor = 1;
  for (int round = 0; round < kMostRounds; ++round) {
    const Precision stricter{target.E_d / factor, target.scale / factor, target.b / factor};
    const Counts counts = counts_of(units, Search(units, stricter, sizes.wheelbase_m).best());
    if (std::accumulate(counts.begin(), counts.end(), 0) > kMostRuns) refuse_too_fine();
    const Forecast found = forecast(sizes.with(counts));
    const double missed = excess(found.relative(), target);
    if (missed <= 1) return found;
    factor *= std::max(missed, 1.0001);
  }
  throw Error("no programme of these runs was found", {Help::give_other_sizes});
}

}  // namespace astro::simulation::study
