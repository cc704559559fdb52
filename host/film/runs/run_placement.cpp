#include "host/film/runs/run_placement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace astro::film {
namespace {

constexpr double kTurnArm_m = 0.15;   // lever arm by which a turn rate counts as a speed
constexpr double kSpeedWeight = 0.5;  // because the tag's speed differs from the robot's while it turns
constexpr double kHalfWindow_s = 0.1, kGap_s = 0.35;

struct Place {
  double time_s, x_m, y_m, theta_rad;
};

Place between(const Place& a, const Place& b, double time_s) {
  const double span = b.time_s - a.time_s, part = span > 0 ? (time_s - a.time_s) / span : 0;
  return {time_s, a.x_m + part * (b.x_m - a.x_m), a.y_m + part * (b.y_m - a.y_m),
          a.theta_rad + part * (b.theta_rad - a.theta_rad)};
}

MotionRates rates_of_places(const std::vector<Place>& places) {
  MotionRates rates;
  if (places.size() < 2) return rates;
  rates.first_s = places.front().time_s;
  const auto count =
      static_cast<std::size_t>((places.back().time_s - places.front().time_s) / MotionRates::kBin_s) + 1;
  rates.bins.resize(count);
  std::size_t from = 1, to = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double middle_s = rates.first_s + MotionRates::kBin_s * static_cast<double>(i);
    const double begin_s = middle_s - kHalfWindow_s, end_s = middle_s + kHalfWindow_s;
    while (from + 1 < places.size() && places[from].time_s < begin_s) ++from;
    while (to + 1 < places.size() && places[to].time_s < end_s) ++to;
    if (begin_s < places.front().time_s || end_s > places.back().time_s) continue;
    bool gap = false;
    for (std::size_t k = from; k <= to; ++k) gap = gap || places[k].time_s - places[k - 1].time_s > kGap_s;
    if (gap) continue;
    const Place a = between(places[from - 1], places[from], begin_s),
                b = between(places[to - 1], places[to], end_s);
    const double dt_s = 2 * kHalfWindow_s;
    rates.bins[i] = {static_cast<float>(kTurnArm_m * (b.theta_rad - a.theta_rad) / dt_s),
                     static_cast<float>(kSpeedWeight * std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / dt_s),
                     true};
  }
  return rates;
}

constexpr double kStep_s = MotionRates::kBin_s;
constexpr double kApart_s = 2;       // places that are nearer count as one
constexpr double kPlausible = 0.85;  // of the mean likeness of the runs placed alone
constexpr std::size_t kMostPlaces = 24;

/// The range of offsets in which run and film overlap by at least half of the run.
struct Offsets {
  double from, to;
};
Offsets possible(const MotionRates& run, const MotionRates& film) {
  const double half = (run.end_s() - run.first_s) / 2;
  return {run.first_s + half - film.end_s(), run.end_s() - half - film.first_s};
}

/// Refines a rough offset to a hundredth of a bin.
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

/// All places of one run that are nearly as good as the best; the best is the first.
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

/// Finds one offset for all runs, then refines each run's own offset within the drift of the clocks.
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

/// The places, in the order of the runs, that do not overlap and have the largest sum of likenesses (dynamic
/// programming over the candidates).
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
  constexpr double kOverlap_s = 0.5;  // because runs rest at their ends
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

MotionRates rates_of(const std::vector<film::FilmPose>& poses) {
  std::vector<Place> places;
  for (const film::FilmPose& pose : poses)
    places.push_back({pose.time_s, pose.pose.x_m, pose.pose.y_m, pose.pose.theta_rad});
  return rates_of_places(places);
}

MotionRates rates_of(const recording::Run& run) {
  std::vector<Place> places;
  for (const recording::OdometrySample& sample : run.odometry) {
    const double time_s = 1e-6 * static_cast<double>(sample.time_us);
    if (!places.empty() && time_s <= places.back().time_s) continue;
    places.push_back({time_s, sample.x_m, sample.y_m, sample.theta_rad});
  }
  return rates_of_places(places);
}

Likeness likeness(const MotionRates& run, const MotionRates& film, double offset_s) {
  const double shift = (run.first_s - offset_s - film.first_s) / MotionRates::kBin_s;
  const double whole = std::floor(shift);
  const float part = static_cast<float>(shift - whole);
  const auto first = static_cast<std::ptrdiff_t>(whole), size = static_cast<std::ptrdiff_t>(film.bins.size());
  float both = 0, run_squares = 0, film_squares = 0, shown = 0;
  double sums[4] = {};  // by blocks, because a long sum of floats loses digits
  const auto add_block = [&] {
    std::size_t k = 0;
    for (float* const value : {&both, &run_squares, &film_squares, &shown})
      sums[k++] += static_cast<double>(std::exchange(*value, 0.0F));
  };
  for (std::size_t i = 0; i < run.bins.size(); ++i) {
    const MotionRate& a = run.bins[i];
    if (!a.known) continue;
    const float square = a.turn * a.turn + a.speed * a.speed;
    run_squares += square;
    if (i % 256 == 255) add_block();
    const std::ptrdiff_t at = first + static_cast<std::ptrdiff_t>(i);
    if (at < 0 || at + 1 >= size) continue;
    const MotionRate &low = film.bins[static_cast<std::size_t>(at)],
                     &high = film.bins[static_cast<std::size_t>(at + 1)];
    if (!low.known || !high.known) continue;
    const float turn = low.turn + part * (high.turn - low.turn),
                speed = low.speed + part * (high.speed - low.speed);
    film_squares += turn * turn + speed * speed;
    both += a.turn * turn + a.speed * speed;
    shown += square;
  }
  add_block();
  const auto [product, run_all, film_all, run_shown] = sums;
  if (!(run_all > 0)) return {};
  return {2 * product / (run_all + film_all),
          run_shown + film_all > 0 ? 2 * product / (run_shown + film_all) : 0, run_shown / run_all};
}

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
    // If the robot's clock restarted between two runs, they fit badly with one offset.
    if (runs.size() == 1) together.front().ambiguous = has_rival(candidates.front());
    if (mean_likeness(together) > kPlausible * alone || runs.size() == 1) return together;
  }
  return placed_in_order(runs, candidates, order);
}

}  // namespace astro::film
