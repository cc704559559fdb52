#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "host/calibration/wall/gap_doubt.hpp"
#include "host/calibration/wall/wall_estimate.hpp"
#include "host/calibration/wall/wall_plan.hpp"
#include "host/experiment/wall/wall_drive.hpp"
#include "host/experiment/wall/wall_journal.hpp"

namespace astro::experiment {

/// Callbacks through which a calibration against a wall shows progress and asks its user.
struct WallHooks {
  WallDriver::Hooks drive;
  /// Before the robot first creeps towards the wall, and after it was lifted or its link was lost: it has to face the wall, a hand's
  /// breadth to 0.6 m in front of it. Returns when it does.
  std::function<void()> placed = [] {};
  /// The robot has backed off: what the ruler shows between wall and front. Nothing: nobody reads it.
  std::function<std::optional<double>(double expected_m)> read_gap = [](double) { return std::nullopt; };
  /// Whether a gap that looks wrong is right; if not it is read again.
  std::function<bool(const calibration::GapDoubt&)> is_right = [](const calibration::GapDoubt&) {
    return true;
  };
  /// Moves count from 1; `total` as expected now.
  std::function<void(const calibration::WallMove&, int number, int total)> move_started =
      [](const calibration::WallMove&, int, int) {};
  /// The robot is flush again: what is known so far.
  std::function<void(const calibration::WallEstimate&)> squared = [](const calibration::WallEstimate&) {};
};

struct WallResult {
  calibration::WallEstimate estimate;
  WallJournal journal;
  WallRobot robot;
  bool reached = false;  // the wanted precision of E_d and b
};

/// The whole calibration in front of a wall: squares the robot, drives the moves of plan_course, squares it after each, and estimates.
/// Lines go on until E_d and b are as precise as wanted, or the time is over. What was driven is in `folder` after each move, and the
/// same call goes on from there, with the robot put in front of the wall anew.
///
/// A move after which the robot has turned or stands otherwise than its wheels can tell (SquaringDoubt) is driven again, as if the robot had been
/// lifted; the third in a row is an error.
///
/// Throws astro::Error for a plan that this robot cannot drive, and as WallDriver does.
WallResult run_wall_experiment(robot::Client& client, const WallPlan& plan,
                               const std::filesystem::path& folder, const WallHooks& hooks);

/// What the plan wishes of plan_course, on this robot.
calibration::WallWishes wishes_of(const WallPlan& plan, const WallRobot& robot);

}  // namespace astro::experiment
