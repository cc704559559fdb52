#pragma once

#include "common/protocol/telemetry.hpp"
#include "host/recording/run.hpp"

namespace astro::recording {

/// A sample of the robot's telemetry in SI units, on the robot's clock. Precondition: it has the groups pose, counts and twist.
/// The pose with the gyro is there if the group fused is, and the robot uses a gyro.
OdometrySample to_sample(const protocol::Telemetry& telemetry);
GyroSlip to_sample(const protocol::SlipFound& found);

}  // namespace astro::recording
