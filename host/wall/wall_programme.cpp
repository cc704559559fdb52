#include "host/wall/wall_programme.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace astro::wall {
namespace {

using Kind = WallMove::Kind;

constexpr std::size_t kMostMoreGaps = 2;

std::ptrdiff_t gaps_driven(const WallJournal& journal) {
  return std::count_if(journal.moves.begin(), journal.moves.end(),
                       [](const WallMove& move) { return move.kind == Kind::gap; });
}

std::size_t more_gaps(const WallJournal& journal) {
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, gaps_driven(journal) - journal.plan.readings));
}

/// By what standard errors have to be smaller than wanted.
double surely(const WallEstimate& estimate) {
  const auto stretches = static_cast<double>(std::max<std::size_t>(estimate.stretches.size(), 1));
  return std::sqrt(1 + std::sqrt(2 / stretches));
}

}  // namespace

WallWishes wishes_of(const WallPlan& plan, const WallRobot& robot) {
  WallWishes wishes;
  wishes.targets = plan.targets;
  wishes.line_m = plan.line_m;
  wishes.turning_m = plan.body.turning_gap_m();
  wishes.readings = plan.readings;
  wishes.gap_m = plan.gap_m;
  wishes.speed_mps = std::min(plan.speed_mps, robot.speed_limit_mps);
  wishes.yaw_rate_radps = std::min(plan.yaw_rate_radps, robot.yaw_rate_limit_radps);
  wishes.noise = plan.usual_noise();
  wishes.acceleration_mps2 = robot.acceleration_mps2;
  wishes.yaw_acceleration_radps2 = robot.yaw_acceleration_radps2;
  return wishes;
}

bool is_precise(const WallEstimate& estimate, const WallTargets& wanted) {
  return estimate.se.E_d * surely(estimate) <= wanted.E_d && estimate.se.b * surely(estimate) <= wanted.b;
}

std::optional<WallMove> next_move(const WallJournal& journal, const WallEstimate& estimate,
                                  const WallRobot& robot) {
  const WallPlan& plan = journal.plan;
  WallWishes wishes = wishes_of(plan, robot);
  const std::size_t driven = journal.moves.size();
  const std::size_t fixed = kFirstMoves + static_cast<std::size_t>(plan.readings);
  if (driven < fixed) return plan_course(wishes, journal.loaded).moves[driven];
  const std::size_t more = more_gaps(journal);
  if (estimate.scale && estimate.scale->contradictory() && more < kMostMoreGaps)
    return WallMove{Kind::gap, plan.gap_m, 0, 0};
  if (is_precise(estimate, plan.targets)) return std::nullopt;
  const int index = static_cast<int>(driven - std::min(driven, fixed + more));
  const bool laps = estimate.se.E_d * surely(estimate) > plan.targets.E_d;
  wishes.noise = estimate.noise;
  WallMove move = laps ? laps_number(index, wishes) : spin_number(index, wishes, estimate.b_per_scale_m);
  for (; move.turns != 0; move.turns -= move.turns > 0 ? 1 : -1)  // fewer turns may still be in time
    if (journal.driven_s + time_of(move, wishes) <= 60 * plan.most_minutes) return move;
  return std::nullopt;
}

int gaps_left(const WallJournal& journal) {
  return std::max(0, journal.plan.readings - static_cast<int>(gaps_driven(journal)));
}

}  // namespace astro::wall
