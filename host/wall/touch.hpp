#pragma once

#include <array>

#include "host/base/error.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/wall/wall_robot.hpp"
#include "host/wall/wheel_watch.hpp"

/// A robot squares itself against a wall that it faces: it creeps on until it touches, and goes on to push gently, so that the
/// corner which touches first stays and the other one comes up.
///
/// Force  open loop by voltages, never more than push_voltage_V, so the motors cannot push harder, whatever the robot meets and
///        whatever the link does. If no more voltages arrive, the robot's own time-out opens the bridges after 200 ms.
/// Time   a wheel that stands has voltage for kStall_s at most; then both wheels rest for kPause_s with their motors shorted,
///        and the robot pushes again. The robot is flush when two pushes in a row end at the same place. Without telemetry the
///        voltage is not renewed, and after 0.3 s it is taken away. Because of the time-out of 200 ms no motor is stalled for
///        more than 0.9 s, even if the host dies at the worst moment.
/// Speed  kCreep_mps. The impact of the body adds to the push: body and rotors of the reference robot, 9 kg together, have 1 mJ
///        at 15 mm/s. A front that gives way by 1 mm under 20 N absorbs this with 6 N, before the voltage rises to the push.
namespace astro::wall {

inline constexpr double kCreep_mps = 0.015;
inline constexpr double kStall_s = 0.6, kPause_s = 0.2;

/// The robot did not become flush:
///   no wheel turned on the voltage of the set force
///   a wheel ran away backwards on a forward voltage: its motor or its encoder is reversed
///   the robot has turned by more than 0.8 rad, which no wall does to a robot that faces it
///   nothing was touched within the distance in which the wall was expected
///   the robot was still turning or sliding after all pushes, or after half a minute
class NotFlush : public Error {
 public:
  using Error::Error;
};

struct Touch {
  double crept_m = 0;  // mean of both wheels, from the start to the end, nominal
  int pushes = 0;
  double longest_stall_s = 0;  // of a wheel with voltage, as far as telemetry shows it
};

/// `within_m`: the largest distance at which the wall can be. Precondition: at rest; the wall is ahead. The robot stays armed,
/// at rest, with its motors shorted.
///
/// Throws NotFlush, and as DriveSession does.
Touch square_against_wall(robot::DriveSession& session, WheelWatch& watch, robot::Client& client,
                          const WallRobot& robot, double push_V, double within_m);

}  // namespace astro::wall
