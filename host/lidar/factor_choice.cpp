#include "host/lidar/factor_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "host/lidar/piece_errors.hpp"

namespace astro::lidar {
namespace {

constexpr std::size_t kFolds = 5, kFewestStretches = 25, kFewestPieces = 8;
constexpr double kLongestPiece_m = 5, kShortestPiece_m = 1, kPieces = 25;
/// Errors of a piece below this are those of the matches, per metre.
constexpr double kFloor = 0.004;
/// From the smallest to the largest.
constexpr std::array<FactorSet, 6> kSets{{{"E", false, false, true},
                                          {"G", false, true, false},
                                          {"S", true, false, false},
                                          {"GE", false, true, true},
                                          {"SG", true, true, false},
                                          {"SGE", true, true, true}}};
/// What is known of factors without which other drives are followed as well: a nominal wheel is known to half a per cent, a
/// wheelbase by a ruler to one, and a real robot's wheels of the same make had an E_d of 0.9989 at a wheelbase of 0.25 m.
constexpr double kKeptScale = 0.005, kKeptTurn = 0.01, kKeptBend_radpm = 0.004;

/// Only the scanner's place and its clock are not known.
Prior as_loaded(const Unknowns& start, bool late) {
  Prior prior = wide_prior(start, late);
  for (const Unknown factor : {kScale, kTurn, kBend, kArcs}) prior.deviation(factor) = 0;
  prior.mean = start;
  return prior;
}

/// The matched stretches outside of [first, last).
std::vector<LinearStretch> without(std::span<const LinearStretch> linear, std::size_t first,
                                   std::size_t last) {
  std::vector<LinearStretch> others;
  for (const LinearStretch& one : linear)
    if (one.index < first || one.index >= last) others.push_back(one);
  return others;
}

double length_of(std::span<const Stretch> stretches) {
  double length_m = 0;
  for (const Stretch& stretch : stretches)
    if (stretch.scanner) length_m += std::hypot(stretch.scanner->motion.x_m, stretch.scanner->motion.y_m);
  return length_m;
}

/// Errors of the held-out pieces of all folds with the factors of a set that were found without each.
std::vector<PieceError> held_out(std::span<const Stretch> stretches, std::span<const LinearStretch> linear,
                                 const Unknowns& at, const Prior& prior,
                                 const calibration::WheelFactors& loaded, double piece_m) {
  std::vector<PieceError> all;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    const std::size_t first = fold * stretches.size() / kFolds, last = (fold + 1) * stretches.size() / kFolds;
    const std::vector<LinearStretch> others = without(linear, first, last);
    if (others.size() < 3) return {};
    const std::vector<PieceError> errors = piece_errors(stretches.subspan(first, last - first), piece_m,
                                                        fit(others, at, prior).unknowns, loaded);
    for (PieceError error : errors) {
      error.first += first;
      all.push_back(error);
    }
  }
  return all;
}

/// Numbers of groups of pieces that begin within `length_m` of driving.
std::vector<std::size_t> groups_of(std::span<const PieceError> pieces, std::span<const Stretch> stretches,
                                   double length_m) {
  std::vector<double> way_m{0};
  for (const Stretch& stretch : stretches)
    way_m.push_back(way_m.back() + (stretch.scanner
                                        ? std::hypot(stretch.scanner->motion.x_m, stretch.scanner->motion.y_m)
                                        : 0));
  std::vector<std::size_t> groups;
  for (const PieceError& piece : pieces)
    groups.push_back(static_cast<std::size_t>(way_m[piece.first] / length_m));
  return groups;
}

/// Mean of values of pieces that overlap, and its standard error. Pieces that begin within two lengths are put together, and
/// these groups are taken to be independent.
struct MeanOfGroups {
  double mean = 0, error = std::numeric_limits<double>::infinity();
  std::size_t groups = 0;
};

MeanOfGroups mean_of_groups(const std::vector<std::pair<std::size_t, double>>& grouped) {
  std::vector<std::pair<double, double>> groups;  // sum and count
  std::size_t last = static_cast<std::size_t>(-1);
  double sum = 0, count = 0;
  for (const auto& [group, value] : grouped) {
    if (groups.empty() || group != last) groups.emplace_back(0, 0);
    last = group;
    groups.back().first += value;
    groups.back().second += 1;
    sum += value;
    count += 1;
  }
  MeanOfGroups found{sum / count, std::numeric_limits<double>::infinity(), groups.size()};
  if (groups.size() < 2) return found;
  double squares = 0;
  for (const auto& [part, weight] : groups) squares += std::pow(part - weight * found.mean, 2);
  const double n = static_cast<double>(groups.size());
  found.error = std::sqrt(squares * n / (n - 1)) / count;
  return found;
}

/// How much smaller the errors are, piece by piece. `groups`: that of each piece.
void compare(std::span<const PieceError> before, std::span<const PieceError> after,
             std::span<const std::size_t> groups, FactorChoice& choice) {
  choice.loaded_rms_m = rms_m(before);
  choice.rms_m = rms_m(after);
  const double floor_m = kFloor * choice.piece_m;
  std::vector<std::pair<std::size_t, double>> gains;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double was_m = before[i].distance_m, is_m = after[i].distance_m;
    gains.emplace_back(groups[i], std::log((was_m + floor_m) / (is_m + floor_m)));
  }
  const MeanOfGroups gain = mean_of_groups(gains);
  choice.gain = gain.mean;
  choice.gain_se = gain.error;
  choice.pieces = gain.groups;
}

}  // namespace

Prior FactorSet::prior(const Unknowns& start, bool late) const {
  Prior prior = wide_prior(start, late);
  if (!scale) prior.deviation(kScale) = kKeptScale;
  if (!turn) {
    prior.deviation(kTurn) = kKeptTurn;
    prior.mean(kArcs) = start(kArcs);
  }
  if (!bend) prior.deviation(kBend) = kKeptBend_radpm;
  return prior;
}

bool FactorChoice::better() const {
  constexpr double kLeast = 0.1;
  return gain > 2 * gain_se && gain > kLeast && rms_m < (1 - kLeast) * loaded_rms_m;
}
bool FactorChoice::worse() const { return -gain > 2 * gain_se && rms_m > loaded_rms_m; }

bool can_be_judged(const FactorChoice& choice) { return choice.pieces >= kFewestPieces; }

FactorChoice choose_factors(std::span<const Stretch> stretches, std::span<const LinearStretch> linear,
                            const Unknowns& at, const Unknowns& start, bool late,
                            const calibration::WheelFactors& loaded) {
  const double piece_m = std::clamp(length_of(stretches) / kPieces, kShortestPiece_m, kLongestPiece_m);
  FactorChoice none;
  none.piece_m = piece_m;
  if (linear.size() < kFewestStretches) return none;
  const std::vector<PieceError> before =
      held_out(stretches, linear, at, as_loaded(start, late), loaded, piece_m);
  const std::vector<std::size_t> groups = groups_of(before, stretches, 2 * piece_m);
  none.pieces = std::set<std::size_t>(groups.begin(), groups.end()).size();
  if (!can_be_judged(none)) return none;
  std::array<FactorChoice, kSets.size()> choices;
  for (std::size_t i = 0; i < kSets.size(); ++i) {
    choices[i].set = kSets[i];
    choices[i].piece_m = piece_m;
    compare(before, held_out(stretches, linear, at, kSets[i].prior(start, late), loaded, piece_m), groups,
            choices[i]);
  }
  const FactorChoice& best =
      *std::max_element(choices.begin(), choices.end(),
                        [](const FactorChoice& a, const FactorChoice& b) { return a.gain < b.gain; });
  const auto smallest = std::find_if(choices.begin(), choices.end(), [&](const FactorChoice& choice) {
    return choice.gain >= best.gain - best.gain_se;
  });
  return smallest == choices.end() ? none : *smallest;  // no gain is a number
}

}  // namespace astro::lidar
