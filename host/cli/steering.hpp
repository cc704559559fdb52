#pragma once

#include "host/link/drive.hpp"

namespace astro::cli {

/// Repeats a velocity often enough for the robot's command time-out, by the robot's own clock: that of a
/// simulator in fast motion runs ahead of ours. Needs telemetry at 20 ms or less to see that clock.
class Steering {
 public:
  Steering(link::Client& client, link::DriveSession& session) : client_(client), session_(session) {}

  /// Sends the velocity and waits until the next one is due, at most 50 ms. Throws as DriveSession does.
  void step(double v_mps, double omega_radps);

  /// Until this long has passed on the robot's clock since the call; then ramps to rest.
  void hold(double v_mps, double omega_radps, link::microseconds duration);

 private:
  link::Client& client_;
  link::DriveSession& session_;
};

}  // namespace astro::cli
