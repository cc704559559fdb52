#pragma once

#include "host/motor/wiring/wiring.hpp"
#include "host/motor/bench/bench.hpp"

namespace astro::motor {

/// Drives one motor, forward as the robot believes, until an encoder has seen a quarter turn of a wheel, and
/// brakes: the voltage rises by 2 V/s to where something moves, and by at most half a volt from there.
/// Without an encoder that counts it goes up to `most_V`, stays there for a moment, and ends: a person can
/// see the wheel turn all the same.
///
/// Throws as DriveSession does. Nothing moves when it returns.
motor::Probe probe_motor(Bench& bench, robot::DriveSession& session, motor::Side motor,
                                  double most_V);

}  // namespace astro::motor
