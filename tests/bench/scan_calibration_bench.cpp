// How good calibrations by the scans of an RPLIDAR A1 are: robots with random wheels that drive about in a furnished room, and how
// long a recording of an hour takes.
//
//   scan_calibration [ROBOTS]     exit code 1 if a bar is missed
#include <fmt/format.h>

#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "host/import/scans/scanned_drives.hpp"
#include "host/lidar/keyframes.hpp"
#include "host/lidar/scan_calibration.hpp"
#include "tests/host/import/scans/scan_bag.hpp"
#include "tests/host/lidar/synthetic_room.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::lidar {
namespace {

/// Ratio E_d, b / S and S, relative to the truth or to one.
using Figures = Eigen::Vector3d;

Figures figures_of(const calibration::WheelFactors& factors) {
  const double scale = (factors.c_r + factors.c_l) / 2;
  return {factors.c_r / factors.c_l, factors.b_m / scale, scale};
}

Scanner a1(std::mt19937_64& random) {
  std::uniform_real_distribution<double> place(-0.1, 0.1), turn(-3.14, 3.14);
  Scanner scanner;
  scanner.place = {place(random), place(random), turn(random)};
  scanner.period_s = 1 / 5.5;
  scanner.noise_m = 0.0005;
  scanner.noise_of_range = 0.005;
  scanner.lost = 0.01;
  scanner.spins = true;
  return scanner;
}

/// Wheels as robots have them; e as likely as its prior says.
Robot some_robot(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double ratio = 1 + 0.004 * normal(random), scale = 1 + 0.005 * normal(random);
  return {{scale * std::sqrt(ratio), scale / std::sqrt(ratio), kNominalBase_m * (1 + 0.01 * normal(random)),
           0.02 * normal(random)},
          2.6e-6};
}

/// Goes to random places, as a person would drive, with an arc now and then.
void drive_about(SyntheticDrive& drive, double minutes, std::mt19937_64& random) {
  constexpr double kSpeed_mps = 0.4, kTurn_radps = 1, kArc_radps = 0.8;
  std::uniform_real_distribution<double> x(-2.5, 2.5), y(-2, 2), arc(2, 6);
  double lasts_s = 0;
  const auto go = [&](const Leg& leg) {
    drive.drive(leg);
    lasts_s += leg.lasts_s;
  };
  for (int leg = 0; lasts_s < 60 * minutes; ++leg) {
    const Pose2 at = drive.pose();
    const Point2 to{x(random), y(random)};
    const double turn_rad = wrapped_rad(std::atan2(to.y_m - at.y_m, to.x_m - at.x_m) - at.theta_rad);
    go({0, std::copysign(kTurn_radps, turn_rad), std::abs(turn_rad) / kTurn_radps});
    go({kSpeed_mps, 0, std::hypot(to.x_m - at.x_m, to.y_m - at.y_m) / kSpeed_mps});
    if (leg % 3 == 2) go({kSpeed_mps, leg % 2 == 0 ? kArc_radps : -kArc_radps, arc(random)});
  }
}

/// The covariance of the figures that no unbiased estimate from these matches can beat: with the scatter that the stretches really
/// have about the truth.
Eigen::Matrix3d bound(const ScannedDrive& drive, const Unknowns& truth) {
  const Keyframes keyframes = keyframes_of(drive, kLoaded, truth, false);
  const std::vector<LinearStretch> stretches = linearised(keyframes.stretches, truth, kLoaded);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const LinearStretch& one : stretches) scatter += one.residual * one.residual.transpose();
  scatter /= static_cast<double>(stretches.size());
  const Unknowns priors = wide_prior(truth, true).deviation;
  Information information = priors.cwiseProduct(priors).cwiseInverse().asDiagonal();
  const Eigen::Matrix3d weight = scatter.inverse();
  for (const LinearStretch& one : stretches) information += one.jacobian.transpose() * weight * one.jacobian;
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, 3, kUnknowns> by;
  for (int k = 0; k < kUnknowns; ++k) {
    Unknowns more = truth, less = truth;
    more(k) += kStep;
    less(k) -= kStep;
    by.col(k) = (figures_of(factors_of(more, kLoaded)) - figures_of(factors_of(less, kLoaded))) / (2 * kStep);
  }
  return by * information.inverse() * by.transpose();
}

Unknowns truth_of(const Robot& robot, const Scanner& scanner) {
  Unknowns truth = nothing_wrong(kLoaded);
  const double scale = (robot.actual.c_r + robot.actual.c_l) / 2;
  truth(kScale) = scale;
  truth(kTurn) = kNominalBase_m * scale / robot.actual.b_m;
  truth(kBend) = (robot.actual.c_r - robot.actual.c_l) / robot.actual.b_m;
  truth(kArcs) = robot.actual.e;
  truth(kLeverX) = scanner.place.x_m;
  truth(kLeverY) = scanner.place.y_m;
  truth(kLeverYaw) = scanner.place.theta_rad;
  return truth;
}

Figures by_figures(const ScanCalibration& found, Eigen::Matrix3d& covariance) {
  constexpr double kStep = 1e-7;
  Eigen::Matrix<double, 3, 4> by;
  for (int k = 0; k < 4; ++k) {
    calibration::WheelFactors more = found.factors;
    (k == 0 ? more.c_r : k == 1 ? more.c_l : k == 2 ? more.b_m : more.e) += kStep;
    by.col(k) = (figures_of(more) - figures_of(found.factors)) / kStep;
  }
  covariance = by * found.covariance * by.transpose();
  return figures_of(found.factors);
}

struct Bars {
  bool kept = true;
  void check(const char* what, double value, double bar, const char* unit = "") {
    const bool good = value <= bar;
    kept = kept && good;
    fmt::print("  {:<34} {:.3g}{} (bar {:.3g}){}\n", what, value, unit, bar, good ? "" : "  MISSED");
  }
};

void robots(int count, Bars& bars) {
  // Of all that the drives show; and of what is used, where factors that do not clearly help have a narrower prior.
  Figures squares = Figures::Zero(), used = Figures::Zero(), bounds = Figures::Zero();
  double chi_square = 0, yaw_square = 0, late_square = 0;
  int refused = 0, better = 0;
  for (int i = 0; i < count; ++i) {
    std::mt19937_64 random(static_cast<std::uint64_t>(1000 + i));
    const Robot robot = some_robot(random);
    const Scanner scanner = a1(random);
    SyntheticDrive drive(furnished_room(), robot, scanner, random());
    drive_about(drive, 12, random);
    const ScannedDrive recorded = drive.recorded();
    try {
      const ScanCalibration found = calibrate_by_scans({&recorded, 1}, kLoaded);
      Eigen::Matrix3d covariance;
      const Figures truth = figures_of(robot.actual), error = by_figures(found, covariance) - truth;
      const Figures shown = figures_of(factors_of(found.unknowns, kLoaded)) - truth;
      squares += shown.cwiseQuotient(truth).cwiseAbs2();
      used += error.cwiseQuotient(truth).cwiseAbs2();
      bounds += bound(recorded, truth_of(robot, scanner)).diagonal().cwiseQuotient(truth.cwiseAbs2());
      chi_square += error.dot(covariance.inverse() * error) / 3;
      yaw_square += std::pow(wrapped_rad(found.scanner.theta_rad - scanner.place.theta_rad), 2);
      late_square += found.late_s * found.late_s;
      better += found.choice.better() ? 1 : 0;
    } catch (const Error& error) {
      fmt::print("robot {}: {}\n", i, error.what());
      ++refused;
    }
  }
  const double n = count - refused;
  const Figures rms = (squares / n).cwiseSqrt(), least = (bounds / n).cwiseSqrt();
  fmt::print(
      "{} robots, 12 minutes each, RPLIDAR A1; {} refused, {} shown to be better; stamps {:.2f} ms late\n",
      count, refused, better, 1000 * std::sqrt(late_square / n));
  const Figures rms_used = (used / n).cwiseSqrt();
  bars.check("E_d, rms error of all that the drives show", rms(0), 3e-4);
  bars.check("b / S, rms error of all that the drives show", rms(1), 1e-3);
  bars.check("S, rms error of all that the drives show", rms(2), 1.5e-3);
  bars.check("E_d, rms error of the factors that are used", rms_used(0), 3e-4);
  bars.check("b / S, rms error of the factors that are used", rms_used(1), 1e-3);
  bars.check("S, rms error of the factors that are used", rms_used(2), 1.5e-3);
  bars.check("yaw, rms error", 57.3 * std::sqrt(yaw_square / n), 0.1, " deg");
  bars.check("E_d over its bound", rms(0) / least(0), 1.1);
  bars.check("b / S over its bound", rms(1) / least(1), 1.1);
  bars.check("S over its bound", rms(2) / least(2), 1.1);
  bars.check("chi-square over its expectation", chi_square / n, 1.25);
  bars.check("its inverse", n / chi_square, 1 / 0.8);
}

void hour(Bars& bars) {
  std::mt19937_64 random(7);
  SyntheticDrive drive(furnished_room(), some_robot(random), a1(random), 7);
  drive_about(drive, 60, random);
  const test::TemporaryFolder folder;
  const std::filesystem::path bag = folder.path() / "hour.mcap";
  importing::write_scan_bag(bag, drive, {"/scan"}, 1'790'000'000'000'000'000);
  importing::ImportChoices choices;
  choices.geometry.wheel_diameter_m = 0.066;
  choices.geometry.wheelbase_m = kNominalBase_m;
  const auto began = std::chrono::steady_clock::now();
  const importing::DriveFiles files{bag, bag};
  const importing::ScannedDrives drives = importing::scanned_drives({&files, 1}, choices);
  const ScanCalibration found = calibrate_by_scans(drives.drives, drives.loaded);
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  fmt::print("a bag of an hour, {} scans, {} pairs matched\n", found.counts.scans, found.counts.matched);
  bars.check("reading and calibrating", took_s, 60, " s");
}

}  // namespace
}  // namespace astro::lidar

int main(int argc, char** argv) {
  astro::lidar::Bars bars;
  astro::lidar::robots(argc > 1 ? std::atoi(argv[1]) : 100, bars);
  astro::lidar::hour(bars);
  return bars.kept ? 0 : 1;
}
