#include "host/experiment/film/run_placement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace astro::experiment {
namespace {

constexpr double kStep_s = MotionRates::kBin_s;
constexpr double kApart_s = 2;       // places that are nearer are one
constexpr double kPlausible = 0.85;  // of the likeness that runs have each for itself
constexpr std::size_t kMostPlaces = 24;

/// Of the run's middle: both together overlap by at least half of the shorter one.
struct Offsets {
  double from, to;
};
Offsets possible(const MotionRates& run, const MotionRates& film) {
  const double half = (run.end_s() - run.first_s) / 2;
  return {run.first_s + half - film.end_s(), run.end_s() - half - film.first_s};
}

/// To a hundredth of a bin around a rough offset.
double refined(std::span<const MotionRates* const> runs, const MotionRates& film, double rough_s,
               double reach_s) {
  const auto value = [&](double offset_s) {
    double sum = 0;
    for (const MotionRates* run : runs) sum += likeness(*run, film, offset_s).all;
    return sum;
  };
  double best_s = rough_s, step = reach_s / 4;
  for (double most = value(rough_s); step > kStep_s / 100;) {
    const double before = value(best_s - step), after = value(best_s + step);
    if (before <= most && after <= most) {
      step /= 2;
      continue;
    }
    best_s += before > after ? -step : step;
    most = std::max(before, after);
  }
  return best_s;
}

/// All places of one run that are nearly as good as the best, the best first.
std::vector<Placement> places_of(const MotionRates& run, const MotionRates& film) {
  constexpr double kWorse = 0.15;
  const Offsets range = possible(run, film);
  std::vector<Placement> all;
  for (double offset_s = range.from; offset_s <= range.to; offset_s += kStep_s)
    all.push_back({offset_s, likeness(run, film, offset_s)});
  std::sort(all.begin(), all.end(),
            [](const Placement& a, const Placement& b) { return a.likeness.all > b.likeness.all; });
  std::vector<Placement> peaks;
  for (const Placement& one : all) {
    if (one.likeness.all < all.front().likeness.all - kWorse || peaks.size() >= kMostPlaces) break;
    if (std::none_of(peaks.begin(), peaks.end(), [&](const Placement& peak) {
          return std::abs(peak.offset_s - one.offset_s) < kApart_s;
        }))
      peaks.push_back(one);
  }
  const MotionRates* const alone = &run;
  for (Placement& peak : peaks) {
    peak.offset_s = refined({&alone, 1}, film, peak.offset_s, kStep_s);
    peak.likeness = likeness(run, film, peak.offset_s);
  }
  return peaks;
}

bool has_rival(const std::vector<Placement>& places) {
  return places.size() > 1 && places[1].likeness.all > places[0].likeness.all - kRival;
}

bool one_after_the_other(std::span<const MotionRates> runs) {
  std::vector<std::pair<double, double>> spans;
  for (const MotionRates& run : runs) spans.emplace_back(run.first_s, run.end_s());
  std::sort(spans.begin(), spans.end());
  for (std::size_t i = 1; i < spans.size(); ++i)
    if (spans[i].first < spans[i - 1].second) return false;
  return true;
}

/// One offset for all, then each run's own within what clocks drift.
std::vector<Placement> placed_together(std::span<const MotionRates> runs, const MotionRates& film) {
  constexpr double kDrift_s = 0.15;
  double from = std::numeric_limits<double>::infinity(), to = -from;
  std::vector<const MotionRates*> all;
  for (const MotionRates& run : runs) {
    const Offsets range = possible(run, film);
    from = std::min(from, range.from);
    to = std::max(to, range.to);
    all.push_back(&run);
  }
  double best_s = from, most = -1;
  for (double offset_s = from; offset_s <= to; offset_s += kStep_s) {
    double sum = 0;
    for (const MotionRates& run : runs) sum += likeness(run, film, offset_s).all;
    if (sum <= most) continue;
    most = sum;
    best_s = offset_s;
  }
  best_s = refined(all, film, best_s, kStep_s);
  std::vector<Placement> places;
  for (const MotionRates* run : all) {
    const double own_s = refined({&run, 1}, film, best_s, kDrift_s);
    const double offset_s = std::abs(own_s - best_s) < 2 * kDrift_s ? own_s : best_s;
    places.push_back({offset_s, likeness(*run, film, offset_s)});
  }
  return places;
}

/// Places in the order of the runs that do not overlap and are most alike in all (dynamic programming over the candidates).
std::vector<Placement> placed_in_order(std::span<const MotionRates> runs,
                                       const std::vector<std::vector<Placement>>& candidates,
                                       std::span<const std::size_t> order) {
  struct Step {
    double sum;
    std::size_t before;
  };
  std::vector<std::vector<Step>> steps(order.size());
  const auto begin = [&](std::size_t k, std::size_t c) {
    return runs[order[k]].first_s - candidates[order[k]][c].offset_s;
  };
  const auto end = [&](std::size_t k, std::size_t c) {
    return runs[order[k]].end_s() - candidates[order[k]][c].offset_s;
  };
  constexpr double kOverlap_s = 0.5;  // rests at the ends
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t c = 0; c < candidates[order[k]].size(); ++c) {
      Step step{k == 0 ? 0 : -1e9, 0};
      for (std::size_t p = 0; k > 0 && p < steps[k - 1].size(); ++p)
        if (end(k - 1, p) <= begin(k, c) + kOverlap_s && steps[k - 1][p].sum > step.sum)
          step = {steps[k - 1][p].sum, p};
      steps[k].push_back({step.sum + candidates[order[k]][c].likeness.all, step.before});
    }
  std::vector<Placement> places(runs.size());
  std::size_t at = 0;
  for (std::size_t c = 0; c < steps.back().size(); ++c)
    if (steps.back()[c].sum > steps.back()[at].sum) at = c;
  for (std::size_t k = order.size(); k-- > 0;) {
    places[order[k]] = candidates[order[k]][at];
    places[order[k]].ambiguous = has_rival(candidates[order[k]]);
    at = steps[k][at].before;
  }
  return places;
}

double mean_likeness(const std::vector<Placement>& places) {
  double sum = 0;
  for (const Placement& place : places) sum += place.likeness.all / static_cast<double>(places.size());
  return sum;
}

}  // namespace

std::vector<Placement> place_runs(std::span<const MotionRates> runs, const MotionRates& film,
                                  std::span<const std::size_t> order) {
  if (runs.empty() || film.bins.empty() ||
      std::any_of(runs.begin(), runs.end(), [](const MotionRates& run) { return run.bins.empty(); }))
    return std::vector<Placement>(runs.size());
  std::vector<std::vector<Placement>> candidates;
  double alone = 0;
  for (const MotionRates& run : runs) {
    candidates.push_back(places_of(run, film));
    if (candidates.back().empty()) candidates.back().push_back({});
    alone += candidates.back().front().likeness.all / static_cast<double>(runs.size());
  }
  if (one_after_the_other(runs)) {
    std::vector<Placement> together = placed_together(runs, film);
    // A clock that started again between two runs shows here: together they fit badly.
    if (runs.size() == 1) together.front().ambiguous = has_rival(candidates.front());
    if (mean_likeness(together) > kPlausible * alone || runs.size() == 1) return together;
  }
  return placed_in_order(runs, candidates, order);
}

}  // namespace astro::experiment
