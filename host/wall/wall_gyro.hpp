#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "host/calibration/gyro/gyro_calibration.hpp"
#include "host/experiment/analysis/gyro_runs.hpp"
#include "host/recording/run.hpp"
#include "host/wall/wall_estimate.hpp"
#include "host/wall/wall_journal.hpp"

/// The gyro of a robot that is calibrated in front of a wall. Between two squarings it has turned by whole turns, whatever its wheels
/// slipped, so the gyro's scale does not depend on the wheels.
namespace astro::wall {

/// The moves of a journal as they were recorded, one run each; without samples where nothing was recorded. Each begins and ends at
/// rest, flush with the wall, and the next one of a series begins where it ends.
using MoveRuns = std::vector<recording::Run>;

/// moves/01.mcap, moves/02.mcap, ... of a folder; those of moves that the journal has. One that cannot be read, and one that the robot
/// drove with other settings of its gyro than `info` has, counts as not recorded.
MoveRuns read_moves(const std::filesystem::path& folder, std::size_t moves, const recording::RunInfo& info);
/// `number`: from 1 on.
void write_move(const std::filesystem::path& folder, std::size_t number, const recording::Run& run);

/// The gyro by whole turns: its scale with its error, the bias at the end of each series, and its lag by the wheels. Nothing for a
/// robot without a gyro, and if it has not turned yet. Throws astro::Error of a calibration::GyroProblem.
std::optional<experiment::GyroResult> calibrate_gyro(const MoveRuns& moves, const WallJournal& journal,
                                                     const WallEstimate& estimate);

/// Turns that no wheel saw in the newest move, by its gyro; times from the start of that move. `before`: moves of the same series,
/// from which it is known how the gyro follows the wheels. Nothing without a gyro. What the robot itself reports does not
/// count: a robot that nobody has calibrated takes each turn for a slip.
std::vector<calibration::UnseenTurn> unseen_turns_in(const recording::Run& move,
                                                     std::span<const recording::Run> before,
                                                     const calibration::WheelFactors& factors);

}  // namespace astro::wall
