#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Wheel factors and lever arm from relative poses in closed form: no start value, no iteration, no noise
/// model.
namespace astro::calibration {

/// Travel of both wheels while the robot's twist hardly changed.
struct WheelStep {
  double left = 0, right = 0;  // in any unit of wheel travel: metres of a nominal wheel, or radians
};

/// The same piece of a drive by the wheels and by a sensor on the robot.
struct RelativePose {
  std::vector<WheelStep> steps;  // in order
  Pose2 moved = {};              // sensor's pose at the end, seen from its pose at the start
};

/// A run with headings as relative poses, each long enough to exceed the tracker's noise, and short enough that there are many.
/// `wheelbase_m` need only be roughly right.
std::vector<RelativePose> pieces_of(const PreparedRun& run, const ClockFit& clock, double wheelbase_m);

/// Metres per unit of wheel travel (wheel radii, if the unit is a radian), wheelbase, and pose of the sensor
/// on the robot. A radius is negative if the wheel turns the other way than assumed.
struct RelativePoseFit {
  double r_left = 0, r_right = 0, b_m = 0;
  LeverArm sensor;
  double condition = 1;  // of the equations for b and the lever arm; large if poorly determined
};

/// Heading per unit of travel of each wheel: that of the left one is negative.
struct TurnRates {
  double left = 0, right = 0;
};

/// Returns nothing if the pieces do not determine both rates, because all are straight or all are spins. The sensor's place on
/// the robot has no effect.
std::optional<TurnRates> fit_headings(std::span<const RelativePose> pieces);

/// The robot's pose at the end of a piece, seen from its pose at the start; lengths in wheelbases.
Pose2 displacement(const RelativePose& piece, const TurnRates& rates);

/// Two linear least squares: headings give r / b of each wheel; the displacements, which are linear in b, in
/// the lever arm and in the sine and cosine of its yaw, then give the rest as the eigenvector of the smaller
/// eigenvalue of a 2x2 matrix. Of the two signs the one with b > 0 is returned.
///
/// Nothing if the pieces do not determine every unknown: fewer than three, no turning, no displacement.
/// Source  Censi, Franchi, Marchionni, Oriolo: Simultaneous calibration of odometry and sensor parameters for
///         mobile robots, IEEE T-RO 29(2), 2013, section V; here with the wheel path inside a piece, not its
///         mean speeds.
std::optional<RelativePoseFit> fit_relative_poses(std::span<const RelativePose> pieces);

/// The same with `rounds` of trimming: each round drops the pieces whose error in position or in heading exceeds
/// the (1 - fraction) quantile.
std::optional<RelativePoseFit> fit_relative_poses_trimmed(std::span<const RelativePose> pieces, int rounds,
                                                          double fraction);

/// The relative pose that the sensor should have measured on a robot with these values.
RelativePose predicted(const RelativePose& piece, const RelativePoseFit& fit);

}  // namespace astro::calibration
