#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// The stretch of a drive between two scans that were matched: what the wheels did, and how far the scanner moved.
namespace astro::lidar {

/// Travel of both wheels of a nominal robot (c_R = c_L = 1), in metres.
struct WheelStep {
  double left_m = 0, right_m = 0;
};

/// What the scans say of a stretch. The covariance is that of a ScanMatch.
struct ScannerMotion {
  Pose2 motion;
  Eigen::Matrix3d covariance;
  bool degenerate = false;  // the walls show motion in one direction only
};

struct Stretch {
  double from_s = 0, to_s = 0;           // times of both scans, on the scans' clock
  double late_s = 0;                     // by how much the scans' stamps were taken to be late
  std::vector<WheelStep> steps;          // so short that each is an arc
  WheelStep rate_before, rate_after;     // metres per second at both ends, for what a clock offset changes
  std::optional<ScannerMotion> scanner;  // none if the scans could not be matched
  bool new_drive = false;                // it does not go on where the stretch before it ended
};

/// The unknowns. The first three are relative to the loaded factors: scale S, turn ratio G (headings turn by this much more than
/// with the loaded b / S) and bend E (the heading changes by so much on each metre, rad/m, because the wheels differ). Then e itself
/// (gentle arcs turn about b (1 + e)), the scanner's place on the robot, and by how many seconds the scans' stamps are late.
enum Unknown { kScale, kTurn, kBend, kArcs, kLeverX, kLeverY, kLeverYaw, kLate, kUnknowns };
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// Loaded factors, and a scanner in the robot's middle that looks forward.
Unknowns nothing_wrong(const calibration::WheelFactors& loaded);

/// c_R, c_L, b and e of a robot that carries `loaded`.
calibration::WheelFactors factors_of(const Unknowns& unknowns, const calibration::WheelFactors& loaded);
calibration::LeverArm lever_of(const Unknowns& unknowns);

/// How far the scanner moved, by the wheels: seen from where it was at the first scan.
Pose2 predicted(const Stretch& stretch, const Unknowns& unknowns, const calibration::WheelFactors& loaded);

/// What the wheels did between two moments of the scans' clock, without what the scans say of it. Precondition: two samples at
/// least, whose times do not decrease.
Stretch cut_stretch(std::span<const calibration::WheelSample> wheels, const calibration::WheelFactors& loaded,
                    double from_s, double to_s, double late_s);

}  // namespace astro::lidar
