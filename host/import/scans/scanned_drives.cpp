#include "host/import/scans/scanned_drives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <utility>

#include "host/experiment/analysis/gyro_runs.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/formats/files/bag.hpp"
#include "host/import/scans/bag_scans.hpp"
#include "host/import/scans/carmen_log.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return a == b || fs::equivalent(a, b, ignored);
}

/// The programs that made such logs knew no e.
calibration::WheelFactors log_factors(const RobotGeometry& given) {
  if (!given.wheelbase_m) throw Error("the wheelbase of the robot is not known", ImportProblem::no_wheelbase);
  return {given.c_r, given.c_l, *given.wheelbase_m};
}

void turn_round(const WheelSelection& wheels, lidar::ScannedDrive& drive) {
  for (calibration::WheelSample& sample : drive.wheels) {
    if (wheels.exchanged) std::swap(sample.left_m, sample.right_m);
    if (wheels.reversed) sample = {sample.time_s, -sample.left_m, -sample.right_m};
  }
}

lidar::ScannedDrive drive_of_log(const DriveFiles& files, const ImportChoices& choices,
                                 const calibration::WheelFactors& loaded, std::vector<Remark>& remarks) {
  if (!same_file(files.wheels, files.truth))
    throw Error(
        fmt::format("the scans of '{}' have no times that other wheels share: its wheels have to be its "
                    "own",
                    files.truth.string()),
        ScanFileProblem::wheels_of_other_file, {files.truth.string()});
  CarmenLog log = read_carmen_log(files.truth, loaded.b_m);
  remarks.push_back({fmt::format(
      "{}: {} scans and {} lines of odometry, {:.0f} m and {:.0f} turns; {}", log.drive.name, log.scans,
      log.odometry, log.way_m, log.turned_rad / (2 * std::numbers::pi),
      log.corrected ? "a mapping program has corrected the poses, so the motion onto each scan is left out"
                    : "the poses of the scans are odometry")});
  if (log.damaged > 0)
    remarks.push_back({fmt::format("{}: {} damaged lines were left out", log.drive.name, log.damaged)});
  // The odometry was made with the loaded factors; the wheels are those of a nominal robot.
  for (calibration::WheelSample& sample : log.drive.wheels) {
    sample.left_m /= loaded.c_l;
    sample.right_m /= loaded.c_r;
  }
  turn_round(choices.wheels, log.drive);
  return std::move(log.drive);
}

lidar::ScannedDrive drive_of_run(recording::Run& run, const std::string& name, BagScans scans) {
  run.info.truth_source = "scan";
  calibration::Trajectory trajectory = experiment::trajectory_of(run, name);
  return {name, std::move(trajectory.wheels), 1000 * run.odometry.front().time_us, std::move(scans.read),
          true};
}

void read_logs(std::span<const DriveFiles> files, const ImportChoices& choices, ScannedDrives& all) {
  all.loaded = log_factors(choices.geometry);
  for (const DriveFiles& one : files)
    all.drives.push_back(drive_of_log(one, choices, all.loaded, all.remarks));
}

void read_runs(std::span<const DriveFiles> files, const ImportChoices& choices, const std::string& scan_topic,
               ScannedDrives& all) {
  std::vector<fs::path> wheels;
  for (const DriveFiles& one : files) wheels.push_back(one.wheels);
  ImportedDrives imported = import_wheels(wheels, choices);
  for (std::size_t i = 0; i < files.size(); ++i) {
    recording::Run& run = imported.set.runs[i];
    const std::string& name = imported.set.names[i];
    BagScans scans = scans_in_bag(files[i].truth, scan_topic);
    all.remarks.push_back(
        {fmt::format("{}: {}; scans of {}", name, imported.reports[i].summary, scans.topic)});
    for (const Remark& remark : imported.reports[i].remarks) all.remarks.push_back(remark.in(name + ": "));
    for (const Remark& remark : scans.remarks) all.remarks.push_back(remark.in(name + ": "));
    experiment::require_comparable(imported.set.runs.front().info, imported.set.names.front(), run.info,
                                   name);
    all.drives.push_back(drive_of_run(run, name, std::move(scans)));
  }
  const recording::RunInfo& last = imported.set.runs.back().info;
  all.loaded = experiment::loaded_factors(last, imported.set.names.back());
  all.wheel = experiment::nominal_wheel(last, imported.set.names.back());
  all.set = std::move(imported.set);
  experiment::add_slips(all.drives, all.set);
}

}  // namespace

bool gives_scans(const fs::path& path, const StatedDrives& stated) {
  if (!bag::is_bag(path)) return is_carmen_log(path);
  return stated.truth_topic.empty() && stated.frames.empty() && has_scans_alone(path);
}

ScannedDrives scanned_drives(std::span<const DriveFiles> files, const ImportChoices& choices,
                             const std::string& scan_topic) {
  std::size_t bags = 0;
  for (const DriveFiles& one : files) {
    const bool bag = bag::is_bag(one.truth);
    if (bag) ++bags;
    if (!bag && !is_carmen_log(one.truth))
      throw Error(
          fmt::format("'{}' holds no scans: it is neither a bag nor a log of CARMEN with lines of ODOM and "
                      "FLASER",
                      one.truth.string()),
          ScanFileProblem::not_scans, {one.truth.string()});
  }
  if (bags != 0 && bags != files.size())
    throw Error(
        "bags and logs of CARMEN cannot be calibrated together, because the wheels of the logs are not known",
        ScanFileProblem::not_scans, {files.front().truth.string()});
  if (bags == 0 && !scan_topic.empty())
    throw Error("logs of CARMEN have no topics", ScanFileProblem::no_topics, {files.front().truth.string()});
  ScannedDrives all;
  bags == 0 ? read_logs(files, choices, all) : read_runs(files, choices, scan_topic, all);
  return all;
}

}  // namespace astro::importing
