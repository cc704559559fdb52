#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "host/wall/gap_doubt.hpp"
#include "host/wall/wall_drive.hpp"
#include "host/wall/wall_estimate.hpp"
#include "host/wall/wall_journal.hpp"
#include "host/wall/wall_plan.hpp"

namespace astro::wall {

/// Callbacks through which a calibration against a wall shows progress and asks its user.
struct WallHooks {
  WallDriver::Hooks drive;
  /// Before the robot first creeps towards the wall, and after it was lifted or its link was lost: it has to face the wall, a hand's
  /// breadth to 0.6 m in front of it. Returns when it does.
  std::function<void()> placed = [] {};
  /// The robot has backed off: what the ruler shows between wall and front. Nothing: nobody reads it.
  std::function<std::optional<double>(double expected_m)> read_gap = [](double) { return std::nullopt; };
  /// A gap that looks wrong: what the ruler shows when it is read again, `doubt.read_m` if it is right all the same. One that is not possible is
  /// asked for again. Nothing: nobody reads it.
  std::function<std::optional<double>(const GapDoubt& doubt)> read_again = [](const GapDoubt&) {
    return std::nullopt;
  };
  /// Moves count from 1; `total` as expected now.
  std::function<void(const WallMove&, int number, int total)> move_started = [](const WallMove&, int, int) {};
  /// The robot is flush again: what is known so far.
  std::function<void(const WallEstimate&)> squared = [](const WallEstimate&) {};
};

struct WallResult {
  WallEstimate estimate;
  WallJournal journal;
  WallRobot robot;
  bool reached = false;  // the wanted precision of E_d and b
};

/// The whole calibration in front of a wall: squares the robot, drives the moves of plan_course, squares it after each, and estimates.
/// Lines go on until E_d and b are as precise as wanted, or the time is over. What was driven is in `folder` after each move, and the
/// same call goes on from there, with the robot put in front of the wall anew.
///
/// A move after which the robot has turned or stands otherwise than its wheels can tell (SquaringDoubt) is driven again, as if the robot had been
/// lifted; the third in a row is an error. If the ruler's readings contradict each other, up to two more are asked for.
///
/// The distances that the robot drives follow the scale that was found only within 5 %, so a gap that was misread does not lead
/// it beyond the room that it was given.
///
/// Throws astro::Error for a plan that this robot cannot drive and for a folder that another program drives in, and as WallDriver does.
WallResult run_wall_experiment(robot::Client& client, const WallPlan& plan,
                               const std::filesystem::path& folder, const WallHooks& hooks);

}  // namespace astro::wall
