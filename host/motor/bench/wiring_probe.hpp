#pragma once

#include "host/motor/bench/bench.hpp"
#include "host/motor/model/wiring.hpp"

namespace astro::motor {

/// Drives one motor, forward by the robot's parameters, until an encoder has counted a quarter turn of a wheel,
/// and brakes. The voltage rises by 2 V/s until something moves, and by at most half a volt beyond. If no
/// encoder counts, the voltage rises to `most_V` and stays there for half a second: a person can see the wheel
/// turn nevertheless.
///
/// Throws as DriveSession does. Nothing moves when it returns.
motor::Probe probe_motor(Bench& bench, robot::DriveSession& session, Side motor, double most_V);

}  // namespace astro::motor
