#pragma once

#include "host/robot/motion/drive.hpp"

namespace astro::commands {

/// Repeats a velocity often enough for the robot's command time-out, by the robot's own clock: that of a
/// simulator in fast motion runs ahead of ours. Needs telemetry at 20 ms or less to see that clock.
class Steering {
 public:
  Steering(robot::Client& client, robot::DriveSession& session) : client_(client), session_(session) {}

  /// Sends the velocity and waits until the next one is due, at most 50 ms. Throws as DriveSession does.
  void step(double v_mps, double omega_radps);

  /// Until this long has passed on the robot's clock since the call; then ramps to rest.
  void hold(double v_mps, double omega_radps, robot::microseconds duration);

 private:
  robot::Client& client_;
  robot::DriveSession& session_;
};

}  // namespace astro::commands
