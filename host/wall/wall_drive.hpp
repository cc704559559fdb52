#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "host/base/error.hpp"
#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/wall/touch.hpp"
#include "host/wall/wall_robot.hpp"
#include "host/wall/wheel_watch.hpp"

namespace astro::wall {

/// The robot pushed against something while it followed a path, and was stopped.
class RanIntoSomething : public Error {
 public:
  using Error::Error;
};

/// Straight ahead (backwards if negative), or on the spot.
struct Leg {
  double ahead_m = 0, turns = 0;
};

/// The segment with which a robot whose true factors are `actual` really drives this leg, although it uses `loaded`. By its own
/// odometry the segment is an arc.
robot::Path path_of(const Leg& leg, const calibration::WheelFactors& actual,
                    const calibration::WheelFactors& loaded, robot::PathLimits limits);

/// Drives a robot in front of a wall, leg by leg. Between legs it stands disarmed, so that a person may take their time.
///
/// Errors  RanIntoSomething, NotFlush; and as DriveSession.
class WallDriver {
 public:
  struct Hooks {
    std::function<bool()> interrupted = [] { return false; };
    std::function<void(const Remark&)> notice = [](const Remark&) {};
  };

  WallDriver(robot::Client& client, const WallRobot& robot, double push_V, robot::PathLimits limits,
             Hooks hooks);

  /// The travel since this driver was made.
  const WheelTravel& travel() const { return watch_.travel(); }
  std::uint64_t robot_us() const { return watch_.now().time_us; }

  /// One leg after the other without a rest. `actual`: the robot's factors as far as they are known.
  void drive(std::span<const Leg> legs, const calibration::WheelFactors& actual);

  struct Flush {
    WheelTravel travel;  // at which it was flush
    double crept_m = 0;  // nominal
  };
  /// Squares the robot against the wall.
  Flush square(double within_m);

 private:
  class ObstacleGuard;

  robot::DriveHooks drive_hooks(const ObstacleGuard* guard) const;

  robot::Client& client_;
  const WallRobot& robot_;
  double push_V_;
  robot::PathLimits limits_;
  Hooks hooks_;
  WheelWatch watch_;
};

}  // namespace astro::wall
