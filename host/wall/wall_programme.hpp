#pragma once

#include <optional>

#include "host/wall/wall_estimate.hpp"
#include "host/wall/wall_journal.hpp"
#include "host/wall/wall_plan.hpp"

/// What is driven next in front of a wall.
namespace astro::wall {

/// The largest part by which an estimated scale may lengthen or shorten a drive, compared with the robot's own odometry.
inline constexpr double kFurther = 0.05;

/// The wishes for plan_course that follow from the plan and this robot.
WallWishes wishes_of(const WallPlan& plan, const WallRobot& robot);

/// Whether E_d and b are as precise as wanted. With so few stretches K is hardly known, so the errors are taken for a K that is
/// one standard error larger. Otherwise a drive that happened to slip little would end too early.
bool is_precise(const WallEstimate& estimate, const WallTargets& wanted);

/// First the repetitions, the first laps and the gaps of plan_course; then up to two more gaps if those contradict each other;
/// then laps and spins until E_d and b are precise. Nothing if they are, or if the time is over.
std::optional<WallMove> next_move(const WallJournal& journal, const WallEstimate& estimate,
                                  const WallRobot& robot);

/// How many gaps somebody is still asked for, if they agree.
int gaps_left(const WallJournal& journal);

}  // namespace astro::wall
