#pragma once

#include "common/protocol/telemetry.hpp"
#include "host/recording/run.hpp"

namespace astro::recording {

/// A sample of the robot's telemetry in SI units, on the robot's clock. Precondition: it has the groups pose, counts and twist.
OdometrySample to_sample(const protocol::Telemetry& telemetry);

}  // namespace astro::recording
