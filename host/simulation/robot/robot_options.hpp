#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/sim/config.hpp"

namespace astro::simulation {

/// A robot to be simulated or emulated, as a person describes it: what differs between one robot of this
/// kind and another. The defaults are the robot of the reference measurements, with the errors of its wheels
/// and its wheelbase.
struct RobotOptions {
  double true_wheelbase_m = 0.99521 * sim::Config().nominal_wheelbase_m;
  double true_ed = 1.00416;                        // diameter of the right wheel over that of the left one
  double scale = sim::Config().scale;              // mean true wheel diameter over the nominal one
  double true_e = sim::Config().true_e;            // gentle arcs turn about true_wheelbase_m (1 + true_e)
  double true_kappa0 = sim::Config().true_kappa0;  // wheelbase over the radius at which half of true_e acts
  double slip_m = sim::Config().slip_m;            // variance of the travel per metre; 0: none
  double restart_slip_rad = sim::Config().restart_slip_rad;  // unseen turn at a start after spin and stand
  double counts_per_motor_rev = sim::Config().counts_per_motor_rev;
  double motor_mismatch = sim::Config().motor_mismatch;  // right motor constant over left, minus one
  bool on_stand = false;                                 // with the wheels off the ground
  bool gyro = false;                                     // a gyro on its body, its z axis up
  std::vector<std::string> wiring_faults = {};           // by name, as wiring_fault_names() lists them
  std::optional<double> wall_ahead_m = {};               // distance of a straight wall ahead of its front
  std::uint64_t seed = sim::Config().seed;               // of all noise
};

/// The names of all wiring faults: "left-motor-reversed, right-motor-reversed, ...".
std::string wiring_fault_names();

/// "" if `name` is a wiring fault, else an error message.
std::string wrong_wiring_fault(const std::string& name);

/// Throws astro::Error for an unknown wiring fault.
sim::Config config_of(const RobotOptions& options);

/// Size of a simulated robot's flash.
std::size_t flash_bytes();

}  // namespace astro::simulation
