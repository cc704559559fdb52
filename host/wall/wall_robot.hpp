#pragma once

#include <array>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/robot/parameters/parameters.hpp"

/// What a calibration against a wall needs from the robot's parameters and from its owner.
namespace astro::wall {

/// Why a calibration against a wall ends or cannot be resumed, or what it notices. Values: the wheels
/// (wheels_stand), the wheel if it is one (runs_backwards), how far the robot went (no_wall), the force in N
/// (push_too_weak, push_too_strong), the name in WallPlan and its value (impossible_plan). A squaring that
/// does not count is of the kind of its SquaringDoubt (wall_estimate.hpp).
enum class WallProblem {
  not_at_wall,
  wheels_stand,
  turned_away,
  no_wall,
  runs_backwards,
  readings_contradict,
  slipped,
  impossible_plan,
  push_too_weak,
  push_too_strong,
  journal_damaged,
  other_settings,
  other_robot,
  other_wheel
};

/// The end of a sentence about a robot that is not where it should be.
inline constexpr const char* kFaceWall = ": put it in front of the wall, facing it, with nothing in its way";

/// Outline of the body over the floor, as far as its owner measured it; only roughly needed.
struct BodySize {
  double front_to_axle_m = 0.1625, length_m = 0.325, width_m = 0.337;

  /// The gap in which it can turn on the spot, with a hand's breadth to spare.
  double turning_gap_m() const;
};

/// How hard the robot may push, and the motor data from which the voltage follows: the stall torque at the wheel, from the data
/// sheet.
struct PushLimit {
  double force_N = 12;  // of both wheels together
  double stall_Nm = 1.76, stall_V = 12;
};

struct WallRobot {
  double count_m = 0;  // travel of one count of a nominal wheel (c = 1)
  double wheel_diameter_m = 0;
  calibration::WheelFactors loaded;
  std::array<double, 2> kS_V{}, kV_Vspm{}, kA_Vs2pm{};  // left, right
  double speed_limit_mps = 0, yaw_rate_limit_radps = 0;
  double acceleration_mps2 = 0, yaw_acceleration_radps2 = 0;
  bool uses_gyro = false;
  double gyro_scale = 1;      // that the robot has taken out of what its gyro says
  double half_voltage_V = 0;  // above this the robot takes a wheel that stands for stalled
};

/// Throws astro::Error where the robot lacks a parameter.
WallRobot wall_robot_of(const robot::RemoteParameters& robot);

/// The voltage at which both motors, if stalled, push with force_N together. A motor that turns pushes less, because of its
/// back-EMF, and further losses by friction are not counted on. So no voltage up to this one pushes harder, except for the
/// impact of the body:
///
///   torque = (stall_Nm / (stall_V - kS)) V      because at stall_V friction has taken kS off
///   force  = 2 torque / (diameter / 2)
///
/// Throws astro::Error if the voltage is too low to start the wheels (below 2 kS), or so high that the robot would report a
/// stall.
double push_voltage_V(const PushLimit& limit, const WallRobot& robot);

}  // namespace astro::wall
