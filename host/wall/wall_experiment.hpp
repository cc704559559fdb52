#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "host/experiment/analysis/gyro_runs.hpp"
#include "host/wall/gap_doubt.hpp"
#include "host/wall/wall_drive.hpp"
#include "host/wall/wall_estimate.hpp"
#include "host/wall/wall_journal.hpp"
#include "host/wall/wall_plan.hpp"

namespace astro::wall {

/// Callbacks through which a calibration against a wall shows progress and asks its user.
struct WallHooks {
  WallDriver::Hooks drive;
  /// Called before the robot first creeps towards the wall, also if the calibration is resumed. The robot has to face the wall,
  /// a hand's breadth to 0.6 m in front of it. Returns when it does.
  std::function<void()> placed = [] {};
  /// Called when the robot has backed off. Returns the gap between wall and front that the ruler shows;
  /// nothing if nobody reads it.
  std::function<std::optional<double>(double expected_m)> read_gap = [](double) { return std::nullopt; };
  /// Called if a gap looks wrong. Returns the gap as it is read again, or `doubt.read_m` to confirm it; nothing if nobody reads
  /// it. A gap that is not possible is asked for again.
  std::function<std::optional<double>(const GapDoubt& doubt)> read_again = [](const GapDoubt&) {
    return std::nullopt;
  };
  /// Moves count from 1; `total` as expected now.
  std::function<void(const WallMove&, int number, int total)> move_started = [](const WallMove&, int, int) {};
  /// Called when the robot is flush again, with the estimate so far.
  std::function<void(const WallEstimate&)> squared = [](const WallEstimate&) {};
};

struct WallResult {
  WallEstimate estimate;
  WallJournal journal;
  WallRobot robot;
  bool reached = false;                        // the wanted precision of E_d and b
  std::optional<experiment::GyroResult> gyro;  // of a robot that uses one; names: of the series
};

/// The whole calibration in front of a wall: squares the robot, drives the moves of plan_course, squares it after each, and
/// estimates. It ends when E_d and b are as precise as wanted, or when the time is over. After each move `folder` holds what
/// was driven, and the same call resumes from there after the robot was put in front of the wall again.
///
/// If the squaring after a move contradicts the wheels (SquaringDoubt), the move does not count and is driven again, and a new
/// series begins as if the robot had been lifted. The third such move in a row is an error. If the ruler's readings contradict
/// each other, up to two more are asked for.
///
/// If the robot uses a gyro, each move is recorded (wall_gyro.hpp). A move with turns in which the robot turned without its wheels does
/// not count, either. A gyro that cannot be calibrated is told, and the wheels' result counts without it.
///
/// The estimated scale changes the distances that the robot drives by at most 5 %, so a misread gap does not lead it beyond the
/// room that it was given.
///
/// Throws astro::Error for a plan that this robot cannot drive and for a folder that another program uses, and as WallDriver
/// does.
WallResult run_wall_experiment(robot::Client& client, const WallPlan& plan,
                               const std::filesystem::path& folder, const WallHooks& hooks);

}  // namespace astro::wall
