#include "host/simulation/study/shortest_programme.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/normal_equations.hpp"
#include "host/simulation/study/limits.hpp"

namespace astro::simulation::study {
namespace {

using calibration::FactorCovariance;
using calibration::Precision;
using Information = calibration::FactorCovariance;  // about c_R, c_L, b and e

// The search tries this many steps in either direction, enough to replace a square by lines.
constexpr int kReach = 5;
constexpr int kMostRounds = 20;
constexpr double kTargetMissed = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse_too_fine() {
  throw Error("a precision this fine takes more than " + std::to_string(kMostRuns) +
                  " runs: drive longer ones, ask for less, or lessen the slip",
              ProgrammeProblem::precision_too_fine);
}

struct Target {
  Precision factors;
  std::optional<double> e;

  /// The target divided by `factor`.
  Target over(double factor) const {
    return {{factors.E_d / factor, factors.scale / factor, factors.b / factor},
            e ? std::optional(*e / factor) : std::nullopt};
  }
};

/// 1 if the target is just met, more if it is missed.
double excess(const calibration::MlErrors& se, double b_m, const Target& target) {
  const Precision& factors = target.factors;
  const double most = std::max({se.E_d / factors.E_d, se.scale / factors.scale, se.b_m / b_m / factors.b});
  return target.e ? std::max(most, se.e / *target.e) : most;
}

/// What can be added to a programme at a time: a line, or a pair of turning runs.
struct Unit {
  Kind kind = kSquares;
  int runs = 1;
  double time_s = 0;
  Information information = Information::Zero();
};

Counts counts_of(const std::vector<Unit>& units, const std::vector<int>& numbers) {
  Counts counts{};
  for (std::size_t i = 0; i < units.size(); ++i) counts[units[i].kind] = numbers[i] * units[i].runs;
  return counts;
}

Information information_of(const Forecast& forecast) { return forecast.covariance.inverse(); }

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
  Search(const std::vector<Unit>& units, const Target& target, double wheelbase_m)
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
    const Counts counts = counts_of(units_, numbers);
    if (why_undetermined(counts) || (target_.e && why_e_is_hidden(counts))) return kTargetMissed;
    double time_s = 0;
    Information information = Information::Zero();
    information(calibration::kE, calibration::kE) = calibration::PriorOfE{}.information();
    for (std::size_t i = 0; i < units_.size(); ++i) {
      time_s += numbers[i] * units_[i].time_s;
      information += numbers[i] * units_[i].information;
    }
    const FactorCovariance covariance = information.inverse();
    if (!covariance.allFinite() || !(covariance.diagonal().minCoeff() > 0)) return kTargetMissed;
    return excess(errors_of(covariance, nominal_), nominal_.b_m, target_) <= 1 ? time_s : kTargetMissed;
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
  Target target_;
  calibration::WheelFactors nominal_;
};

void require_e(double target, const std::vector<Kind>& kinds) {
  require_positive(target, "the precision wanted of e");
  Counts one_of_each{};
  for (const Kind kind : kinds) one_of_each[kind] = 1;
  const bool circles = one_of_each[kCircles] != 0;
  if (const auto why = why_e_is_hidden(one_of_each))
    throw Error(*why, circles ? ProgrammeProblem::no_squares_nor_spins : ProgrammeProblem::no_circles);
}

}  // namespace

Forecast shortest_programme(const Precision& precision, const std::vector<Kind>& kinds,
                            const Programme& sizes, std::optional<double> target_e) {
  require_positive(precision.E_d, "the precision wanted of E_d");
  require_positive(precision.scale, "the precision wanted of the scale");
  require_positive(precision.b, "the precision wanted of the wheelbase");
  if (target_e) require_e(*target_e, kinds);
  const Target target{precision, target_e};
  Programme programme = sizes;
  programme.with_e = target_e.has_value();
  const std::vector<Unit> units = units_of(kinds, programme);
  // All runs together may give a little less information than the sum of the units; then the sum has to meet
  // a slightly stricter target.
  double factor = 1;
  for (int round = 0; round < kMostRounds; ++round) {
    const Counts counts = counts_of(units, Search(units, target.over(factor), programme.wheelbase_m).best());
    if (std::accumulate(counts.begin(), counts.end(), 0) > kMostRuns) refuse_too_fine();
    const Forecast found = forecast(programme.with(counts));
    const double missed = excess(found.se, programme.wheelbase_m, target);
    if (missed <= 1) return found;
    factor *= std::max(missed, 1.0001);
  }
  throw Error("no programme of these runs was found: give other sizes");
}

}  // namespace astro::simulation::study
