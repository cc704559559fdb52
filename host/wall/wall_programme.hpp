#pragma once

#include <optional>

#include "host/wall/wall_estimate.hpp"
#include "host/wall/wall_journal.hpp"
#include "host/wall/wall_plan.hpp"

/// What is driven next in front of a wall.
namespace astro::wall {

/// Part by which the robot may drive further, or less far, than its own odometry says because of a scale that was found.
inline constexpr double kFurther = 0.05;

/// What the plan wishes of plan_course, on this robot.
WallWishes wishes_of(const WallPlan& plan, const WallRobot& robot);

/// With so few stretches K is hardly known, and a drive that happened to slip little must not end too early: what counts are the
/// errors for a K that is one standard error larger.
bool is_precise(const WallEstimate& estimate, const WallTargets& wanted);

/// The repetitions, the first laps and the gaps of plan_course in any case; up to two more gaps if those contradict each other; then laps and
/// spins until E_d and b are precise. Nothing if that is reached, or the time is over.
std::optional<WallMove> next_move(const WallJournal& journal, const WallEstimate& estimate,
                                  const WallRobot& robot);

/// How many gaps somebody is still asked for, if they agree.
int gaps_left(const WallJournal& journal);

}  // namespace astro::wall
