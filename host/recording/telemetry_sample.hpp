#pragma once

#include <cstdint>
#include <optional>

#include "common/protocol/telemetry.hpp"
#include "host/recording/run.hpp"

namespace astro::recording {

/// A sample of the robot's telemetry in SI units, on the robot's clock. Precondition: it has the groups pose, counts and twist.
OdometrySample to_sample(const protocol::Telemetry& telemetry);
GyroSlip to_sample(const protocol::SlipFound& found);
/// Nothing without the group fused, and of a robot that uses no gyro.
std::optional<GyroPose> gyro_pose(const protocol::Telemetry& telemetry);

/// The poses with the gyro in a stream of telemetry, each once: the robot has a new one every 10 ms and may send samples more often.
class NewGyroPoses {
 public:
  /// The pose of the next sample; nothing if it has none, or that of the sample before.
  std::optional<GyroPose> next(const protocol::Telemetry& telemetry);

 private:
  std::optional<std::int64_t> last_us_;
};

/// The same as a recording has them: from all its rates one bias is taken, the first. The robot goes on to learn its bias, and rates
/// without the newest one would be those of a gyro whose bias jumps.
class RecordedGyroPoses {
 public:
  std::optional<GyroPose> next(const protocol::Telemetry& telemetry);

 private:
  NewGyroPoses new_poses_;
  std::optional<std::int32_t> bias_uradps_;
};

}  // namespace astro::recording
