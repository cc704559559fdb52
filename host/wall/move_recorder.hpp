#pragma once

#include <utility>

#include "host/recording/run.hpp"
#include "host/recording/telemetry_sample.hpp"
#include "host/robot/client/client.hpp"

namespace astro::wall {

/// Records odometry and gyro of a robot by the telemetry that a WheelWatch has asked for. There are no gyro samples while the gyro
/// does not measure. From the rates of all its recordings the same bias is taken.
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
  recording::RecordedGyroPoses gyro_poses_;
  robot::Subscription subscription_;
};

}  // namespace astro::wall
