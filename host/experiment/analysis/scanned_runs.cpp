#include "host/experiment/analysis/scanned_runs.hpp"

#include <cmath>
#include <utility>

#include "host/experiment/analysis/gyro_runs.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/experiment/analysis/trajectories.hpp"
#include "host/lidar/scan_path.hpp"
#include "host/recording/run_metadata.hpp"

namespace astro::experiment {
namespace {

lidar::ScannedDrive scanned_drive(const recording::Run& run, const std::string& name) {
  constexpr std::int64_t kNanosPerMicro = 1000;
  calibration::Trajectory trajectory = trajectory_of(run, name);
  return {name, std::move(trajectory.wheels), kNanosPerMicro * run.odometry.front().time_us,
          [&run](const lidar::ScanHandler& handle) {
            for (const lidar::Scan& scan : run.scans) handle(scan);
          },
          true};
}

}  // namespace

std::vector<lidar::ScannedDrive> scanned_drives(const RunSet& set) {
  std::vector<lidar::ScannedDrive> drives;
  for (std::size_t i = 0; i < set.runs.size(); ++i)
    drives.push_back(scanned_drive(set.runs[i], set.names[i]));
  add_slips(drives, set);
  return drives;
}

void give_truth_by_scans(recording::Run& run) {
  const std::string name = recording::run_name(run.info);
  const lidar::ScannedDrive drive = scanned_drive(run, name);
  std::vector<recording::TruthSample> truth;
  for (const lidar::ScannedPose& pose : lidar::path_by_scans(drive, loaded_factors(run.info, name)))
    truth.push_back({run.odometry.front().time_us + std::llround(1e6 * pose.time_s), pose.robot.x_m,
                     pose.robot.y_m, pose.robot.theta_rad, pose.valid});
  run.truth = std::move(truth);
}

void give_missing_truth_by_scans(std::span<recording::Run> runs) {
  for (recording::Run& run : runs)
    if (run.truth.empty() && !run.scans.empty()) give_truth_by_scans(run);
}

}  // namespace astro::experiment
