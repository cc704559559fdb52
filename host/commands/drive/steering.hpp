#pragma once

#include "host/robot/motion/drive.hpp"

namespace astro::commands {

/// Repeats a velocity often enough for the robot's command time-out. It uses the robot's clock, because the
/// clock of a simulator in fast motion runs ahead of ours, and needs telemetry at 20 ms or less to see it.
class Steering {
 public:
  Steering(robot::Client& client, robot::DriveSession& session) : client_(client), session_(session) {}

  /// Sends the velocity and waits until the next one is due, at most 50 ms. Throws as DriveSession does.
  void step(double v_mps, double omega_radps);

  /// Holds the velocity for this duration by the robot's clock, then ramps to rest.
  void hold(double v_mps, double omega_radps, microseconds duration);

 private:
  robot::Client& client_;
  robot::DriveSession& session_;
};

}  // namespace astro::commands
