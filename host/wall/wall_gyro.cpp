#include "host/wall/wall_gyro.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "host/base/error.hpp"
#include "host/recording/run_file.hpp"

namespace astro::wall {
namespace {

using calibration::GyroDrive;
using calibration::KnownHeading;

std::filesystem::path move_file(const std::filesystem::path& folder, std::size_t number) {
  return folder / "moves" / fmt::format("{:02}.mcap", number);
}

bool same_gyro(const recording::RunInfo& a, const recording::RunInfo& b) {
  return std::ranges::all_of(std::array{"gyro_axis", "gyro_scale"}, [&](const char* name) {
    const auto in_a = a.parameters.find(name), in_b = b.parameters.find(name);
    return in_a != a.parameters.end() && in_b != b.parameters.end() && in_a->second == in_b->second;
  });
}

void append(recording::Run& run, const recording::Run& next) {
  if (run.odometry.empty()) run.info = next.info;
  run.odometry.insert(run.odometry.end(), next.odometry.begin(), next.odometry.end());
  run.gyro.insert(run.gyro.end(), next.gyro.begin(), next.gyro.end());
}

/// Whether the gyro was recorded from the rest at the start of the move to that at its end.
bool has_gyro(const recording::Run& move) {
  constexpr std::int64_t kAtRest_us = 100'000;
  return move.gyro.size() > 1 && move.odometry.size() > 1 &&
         move.gyro.front().time_us < move.odometry.front().time_us + kAtRest_us &&
         move.gyro.back().time_us > move.odometry.back().time_us - kAtRest_us;
}

/// Moves of a series that follow each other and were recorded, and the headings at their ends.
struct Pieces {
  std::vector<GyroDrive> drives;
  std::vector<std::vector<KnownHeading>> headings;

  void end_piece() {
    if (!has_gyro(run_)) return;
    drives.push_back(experiment::gyro_drive(run_, fmt::format("series {}", drives.size() + 1)));
    headings.push_back({});
    for (const auto& [time_us, heading_rad] : moments_)
      headings.back().push_back(
          {1e-6 * static_cast<double>(time_us - run_.odometry.front().time_us), heading_rad});
    run_ = {};
    moments_.clear();
  }
  void add(const recording::Run& move, double turned_rad) {
    const double before_rad = moments_.empty() ? 0 : moments_.back().second;
    if (moments_.empty()) moments_.emplace_back(move.gyro.front().time_us, 0.0);
    moments_.emplace_back(move.gyro.back().time_us, before_rad + turned_rad);
    append(run_, move);
  }

 private:
  recording::Run run_;
  std::vector<std::pair<std::int64_t, double>> moments_;
};

}  // namespace

MoveRuns read_moves(const std::filesystem::path& folder, std::size_t moves, const recording::RunInfo& info) {
  MoveRuns runs(moves);
  for (std::size_t i = 0; i < moves; ++i) {
    const std::filesystem::path file = move_file(folder, i + 1);
    if (!std::filesystem::exists(file)) continue;
    try {
      recording::Run run = recording::read_run(file);
      if (!run.warning && same_gyro(run.info, info)) runs[i] = std::move(run);
    } catch (const Error&) {  // the wheels' result does not depend on it
    }
  }
  return runs;
}

void write_move(const std::filesystem::path& folder, std::size_t number, const recording::Run& run) {
  std::filesystem::create_directories(move_file(folder, number).parent_path());
  recording::write_run(move_file(folder, number), run);
}

std::optional<experiment::GyroResult> calibrate_gyro(const MoveRuns& moves, const WallJournal& journal,
                                                     const WallEstimate& estimate) {
  Pieces pieces;
  std::size_t move = 0;
  for (const WallSeries& series : journal.drive) {
    for (std::size_t i = 1; i < series.squarings.size(); ++i, ++move) {
      if (has_gyro(moves[move])) {
        pieces.add(moves[move], estimate.stretches[move].turned_rad);
      } else {
        pieces.end_piece();
      }
    }
    pieces.end_piece();
  }
  if (pieces.drives.empty()) return std::nullopt;
  experiment::GyroResult result;
  result.against_wheels = calibration::compare_gyro(pieces.drives, estimate.factors);
  const auto found = calibration::gyro_scale_by_headings(pieces.drives, pieces.headings,
                                                         journal.plan.squaring_rad, result.against_wheels);
  if (!found) return std::nullopt;
  result.scale = found->scale;
  result.against_wheels.biases = found->biases;
  result.by = experiment::GyroReference::wall;
  for (const GyroDrive& drive : pieces.drives) result.names.push_back(drive.name);
  return result;
}

std::vector<calibration::UnseenTurn> unseen_turns_in(const recording::Run& move,
                                                     std::span<const recording::Run> before,
                                                     const calibration::WheelFactors& factors) {
  if (!has_gyro(move)) return {};
  recording::Run joined;
  for (const recording::Run& run : before)
    if (has_gyro(run)) append(joined, run);
  append(joined, move);
  const double began_s =
      1e-6 * static_cast<double>(move.odometry.front().time_us - joined.odometry.front().time_us);
  std::vector<calibration::UnseenTurn> found;
  try {
    const std::vector<GyroDrive> drives{experiment::gyro_drive(joined, "")};
    for (calibration::UnseenTurn slip : calibration::compare_gyro(drives, factors).slips) {
      slip.slip.begin_s -= began_s;
      slip.slip.end_s -= began_s;
      if (slip.slip.begin_s >= 0) found.push_back(slip);
    }
  } catch (
      const Error&) {  // a gyro that cannot be calibrated shows no slips; it is told when the result is made
  }
  return found;
}

}  // namespace astro::wall
