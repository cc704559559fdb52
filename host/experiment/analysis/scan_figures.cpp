#include "host/experiment/analysis/scan_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/calibration/motion/arc.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/analysis/method_text.hpp"
#include "host/lidar/scan_map.hpp"

namespace astro::experiment {
namespace {

constexpr std::size_t kMostPoints = 6000;

Pose2 dead_reckoned(const lidar::ScannedDrive& drive, const calibration::WheelFactors& factors) {
  Pose2 robot;
  for (std::size_t i = 1; i < drive.wheels.size(); ++i) {
    const calibration::WheelSample &from = drive.wheels[i - 1], &to = drive.wheels[i];
    calibration::advance(robot, to.right_m - from.right_m, to.left_m - from.left_m, factors);
  }
  return robot;
}

/// By how much walls at three metres are apart at the end of the drive.
double apart_m(const lidar::ScannedDrive& drive, const lidar::ScanCalibration& found) {
  constexpr double kWalls_m = 3;
  const Pose2 apart = difference(dead_reckoned(drive, found.factors), dead_reckoned(drive, found.loaded));
  return std::hypot(apart.x_m, apart.y_m) + kWalls_m * std::abs(apart.theta_rad);
}

}  // namespace

report::ScanFigures scan_figures(const lidar::ScanCalibration& found,
                                 std::span<const lidar::ScannedDrive> drives, bool mirrored) {
  const lidar::ScannedDrive& drive = *std::ranges::max_element(
      drives, {}, [&](const lidar::ScannedDrive& one) { return apart_m(one, found); });
  lidar::Unknowns place = found.unknowns;
  place(lidar::kLeverX) = found.scanner.x_m;
  place(lidar::kLeverY) = found.scanner.y_m;
  place(lidar::kLeverYaw) = found.scanner.theta_rad;
  place(lidar::kLate) = found.late_s;
  report::ScanFigures figures;
  figures.drive = drive.name;
  figures.before = lidar::map_by_wheels(drive, found.loaded, place, mirrored, kMostPoints);
  figures.after = lidar::map_by_wheels(drive, found.factors, place, mirrored, kMostPoints);
  for (const lidar::StretchResidual& residual : found.residuals)
    figures.residuals.push_back({residual.way_m, residual.loaded, residual.found});
  return figures;
}

report::ReportInput scan_report(const Calibration& found, std::span<const lidar::ScannedDrive> drives,
                                bool mirrored) {
  report::ReportInput input;
  const std::string& robot = found.robot.name;
  input.title = "Odometry calibration" + (robot.empty() ? "" : " of " + robot);
  input.description = {{"Robot", robot.empty() ? "not named in the files" : robot},
                       {"Ground truth", "scans of a laser scanner on the robot"},
                       {"Nominal wheel", found.wheel ? found.wheel->described() : ""},
                       {"Drives", fmt::format("{}", drives.size())}};
  const calibration::WheelFactors &was = found.loaded, &is = found.factors;
  const FactorErrors& se = found.se_another_day;
  input.parameters = {{"c_R", "", was.c_r, is.c_r, se.c_r},
                      {"c_L", "", was.c_l, is.c_l, se.c_l},
                      {"b", "m", was.b_m, is.b_m, se.b_m}};
  if (found.shows_e()) input.parameters.push_back({"e", "", was.e, is.e, se.e});
  input.not_loaded = true;
  input.reason = judgement_sentence(found);
  input.scans = scan_figures(*found.scans(), drives, mirrored);
  input.method = method_text(found);
  return input;
}

}  // namespace astro::experiment
