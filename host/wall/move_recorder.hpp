#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "host/recording/run.hpp"
#include "host/recording/telemetry_sample.hpp"
#include "host/robot/client/client.hpp"

namespace astro::wall {

/// Records odometry and gyro of a robot by the telemetry that a WheelWatch has asked for. There are no gyro samples while the gyro
/// does not measure, or the robot has not stood long enough to know its bias.
///
/// From the rates of all its recordings the same bias is taken, the first that the robot knows. The robot goes on to learn its bias, and
/// rates without the newest one would seem to be those of a bias that walks.
class MoveRecorder {
 public:
  /// `info`: of each recording; the recorder adds when it began.
  MoveRecorder(robot::Client& client, recording::RunInfo info);

  /// What was recorded since the last call. The next recording begins here.
  recording::Run take();

 private:
  void add(const protocol::Telemetry& telemetry);

  recording::RunInfo info_;
  recording::Run run_;
  recording::NewGyroPoses gyro_poses_;
  std::optional<std::int32_t> first_bias_uradps_;
  robot::Subscription subscription_;
};

}  // namespace astro::wall
