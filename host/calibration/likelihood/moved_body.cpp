#include "host/calibration/likelihood/moved_body.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "host/calibration/likelihood/agreement.hpp"
#include "host/calibration/likelihood/normal_equations.hpp"

namespace astro::calibration {
namespace {

// As for mountings that drives show alone (preparation/sessions.cpp).
constexpr double kSame_m = 0.01, kSame_rad = 0.02;
// A gain by chance: squared standard errors of one place, and for each run what the best of all groupings gains.
constexpr double kUnlikely = 25, kUnlikelyOfRun = 2;
// Slip makes the place seem to differ a little from run to run. The best two places then explain two thirds of what a place for
// each run would; two real places explain more than this share.
constexpr double kExplained = 0.8;
constexpr std::size_t kMostSessions = 30;

using Grouping = std::vector<int>;  // the session of each run

/// Ways to group runs into sessions.
class Groupings {
 public:
  explicit Groupings(const MlFit& fit) : fixed_(fit.fixed()), prior_(fit.prior()) {
    for (const InnovationSums& run : fit.sums()) runs_.push_back(reduced(run, fixed_, 0));
  }

  Grouping as_fitted() const {
    Grouping grouping;
    for (const Reduced& run : runs_) grouping.push_back(run.session);
    return grouping;
  }

  /// By how much -2 log likelihood is below that of the fit.
  double gain(const Grouping& grouping) const {
    const Pool pool = pooled(grouping);
    std::map<int, SharedVector> steps;
    double sum = prior_gain(pool);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const auto [step, is_new] = steps.try_emplace(grouping[i]);
      if (is_new) step->second = pool.step(grouping[i]);
      sum += runs_[i].gradient.dot(step->second);
    }
    return sum;
  }

  /// Whether the bodies of two sessions sit at different places.
  bool differ(const Grouping& grouping, int a, int b) const {
    const Pool pool = pooled(grouping);
    const SharedVector apart = pool.step(a) - pool.step(b);
    return std::hypot(apart[kLeverX], apart[kLeverY]) >= kSame_m ||
           (!fixed_.lever_yaw && std::abs(apart[kLeverYaw]) >= kSame_rad);
  }

  /// By how much the runs scatter more than their noise explains, if they are grouped in this way.
  double scatter_of(const Grouping& grouping) const {
    const Pool pool = pooled(grouping);
    std::vector<Reduced> grouped = runs_;
    for (std::size_t i = 0; i < grouped.size(); ++i) {
      grouped[i].session = grouping[i];
      grouped[i].gradient -= grouped[i].information * pool.step(grouping[i]);
    }
    return std::max(1.0, scatter(disagreements(grouped, fixed_)).ratio());
  }

 private:
  Pool pooled(const Grouping& grouping) const {
    Pool pool(fixed_, prior_);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      Reduced run = runs_[i];
      run.session = grouping[i];
      pool.add(run);
    }
    return pool;
  }

  double prior_gain(const Pool& pool) const {
    return fixed_.e || fixed_.factors ? 0 : prior_.gradient() * pool.factor_step()[kE];
  }

  FixedParameters fixed_;
  PriorOfE prior_;
  std::vector<Reduced> runs_;
};

std::vector<std::size_t> members(const Grouping& grouping, int session) {
  std::vector<std::size_t> runs;
  for (std::size_t i = 0; i < grouping.size(); ++i)
    if (grouping[i] == session) runs.push_back(i);
  return runs;
}

/// The best way to take a new session out of one: beginning with the run that gains most alone, runs change sides as long as
/// that gains.
Grouping split(const Groupings& all, const Grouping& before, int session, int new_session) {
  const std::vector<std::size_t> runs = members(before, session);
  Grouping best = before;
  double most = -1;
  for (const std::size_t run : runs) {
    Grouping alone = before;
    alone[run] = new_session;
    if (const double gain = all.gain(alone); gain > most) most = gain, best = alone;
  }
  constexpr int kMostSweeps = 5;
  bool changed = true;
  for (int sweep = 0; sweep < kMostSweeps && changed; ++sweep) {
    changed = false;
    for (const std::size_t run : runs) {
      Grouping other = best;
      other[run] = best[run] == session ? new_session : session;
      const double gain = all.gain(other);
      if (gain <= most || members(other, session).empty()) continue;
      most = gain, best = other, changed = true;
    }
  }
  return best;
}

Grouping each_alone(const Grouping& grouping, int session, int first_free) {
  Grouping alone = grouping;
  for (const std::size_t run : members(grouping, session)) alone[run] = first_free++;
  return alone;
}

/// The session as several, or as it is if that explains little.
Grouping split_further(const Groupings& all, const Grouping& before, int session) {
  const int first_free = *std::ranges::max_element(before) + 1;
  const double runs = static_cast<double>(members(before, session).size());
  Grouping now = before;
  double gained = all.gain(before);
  const double base = gained;
  for (int next = first_free; now.size() > 1 && next < static_cast<int>(kMostSessions); ++next) {
    Grouping best = now;
    double most = gained;
    int of = session;
    for (int one = session; one < next; one = one == session ? first_free : one + 1) {
      if (members(now, one).size() < 2) continue;
      const Grouping other = split(all, now, one, next);
      if (const double gain = all.gain(other); gain > most) most = gain, best = other, of = one;
    }
    if (most - gained < (kUnlikely + kUnlikelyOfRun * runs) * all.scatter_of(best) ||
        !all.differ(best, of, next))
      break;
    now = best, gained = most;
  }
  if (now == before) return before;
  const double most = all.gain(each_alone(before, session, first_free)) - base;
  return gained - base > kExplained * most ? now : before;
}

}  // namespace

bool split_sessions(const MlFit& fit, PreparedRuns& runs) {
  const bool named = std::ranges::any_of(runs.runs, [](const PreparedRun& run) {
    return !run.source->session.empty() || run.source->ends_only;
  });
  if (named || fit.fixed().factors || fit.fixed().session || runs.runs.size() < 2) return false;
  const Groupings all(fit);
  const Grouping before = all.as_fitted();
  Grouping now = before;
  for (int session = 0; session <= *std::ranges::max_element(before); ++session)
    if (members(now, session).size() > 1) now = split_further(all, now, session);
  if (now == before) return false;
  std::map<int, int> numbers;  // in the order of the runs
  for (std::size_t i = 0; i < now.size(); ++i)
    runs.runs[i].session = numbers.try_emplace(now[i], static_cast<int>(numbers.size())).first->second;
  return true;
}

}  // namespace astro::calibration
