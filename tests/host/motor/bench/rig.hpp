#pragma once

#include <cmath>
#include <map>
#include <string>

#include "hal/sim/motor.hpp"
#include "host/motor/bench/identify.hpp"
#include "host/robot/parameters/upload.hpp"
#include "tests/support/robots/desk.hpp"

/// A simulated robot and what its motors' data sheet says that a measurement must find.
namespace astro::motor {

using motor::MotorModel;

inline sim::Config quiet_robot(bool on_stand) {
  sim::Config config;
  config.on_stand = on_stand;
  config.slip_m = 0;
  return config;
}

/// From the data sheet alone, by hand: stall and no load at 12 V, and the masses. `strength`: of the magnet.
///   kS = R Tc / k    kV = (Ke + R B / k) / r    kA = R J / (k r)
/// with k what is left of Ke behind the gear. The magnet changes Ke; friction and the share that the gear
/// loses stay.
inline MotorModel from_data_sheet(double strength, bool on_stand) {
  const double R = 12.0 / 7.0, w0 = 251.0 * 2 * std::numbers::pi / 60, radius_m = 0.036, gear = 43.8;
  const double Ke = (12.0 - R * 0.35) / w0;    // no load
  const double k = 1.76 / (7.0 - 0.8 * 0.35);  // stall
  const double Tc = k * 0.8 * 0.35, B = k * 0.2 * 0.35 / w0;
  const double J = 1.5e-6 * gear * gear + (on_stand ? 0 : radius_m * radius_m * 4.7 / 2);
  const double k_here = strength * k, Ke_here = strength * Ke;
  return {R * Tc / k_here, (Ke_here + R * B / k_here) / radius_m, R * J / (k_here * radius_m)};
}

/// Sets parameters on the desk's robot.
inline void set(support::Desk& desk, const std::map<std::string, robot::Value>& values) {
  robot::upload(desk.client, values);
}

inline RobotFacts facts_on(support::Desk& desk) {
  return facts_of(robot::RemoteParameters::fetch(desk.client));
}

}  // namespace astro::motor
