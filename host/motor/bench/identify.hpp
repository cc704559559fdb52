#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>

#include "host/motor/bench/bench.hpp"
#include "host/motor/model/motor_model.hpp"

/// Identifies both motors: drives the wheels and fits a motor model to each.
///
/// Course   voltage up and down slowly, forward and then backward (dead zone, gain); then steps of three
///          fifths and of the whole voltage, each forward and backward, twice (time constant). Both wheels
///          get the same voltage, so a robot on the ground drives straight on and comes back.
/// Limits   never more than `voltage_V`. On the ground each move reverses before it is `distance_m` long; a
///          wheel that gets further from the start ends the measurement with an Error. A wheel that stands
///          still at seven tenths of the voltage, or turns backward, also ends it, before the firmware's own
///          stall fault.
namespace astro::motor {

/// Why a measurement of the motors ended. Values: the wheel; for out_of_room also how far it may go, in
/// metres.
enum class BenchProblem { out_of_room, counts_backward, stands, stands_at_little_voltage };

struct Bounds {
  double voltage_V = 5;
  double distance_m = std::numeric_limits<double>::infinity();  // from the start, to either side
};

struct IdentifiedMotor {
  motor::MotorFit fit;
  std::optional<double> breakaway_forward_V, breakaway_backward_V;  // magnitudes

  /// The mean of the observed ones; at least kS.
  double breakaway_V() const;
};

struct IdentifiedMotors {
  std::array<IdentifiedMotor, 2> wheels;
  double seconds = 0;
};

/// `progress` is called with the fraction that is done. Throws astro::Error with one sentence that names the wheel, and
/// as DriveSession does. The wheels stand when it returns.
IdentifiedMotors identify(Bench& bench, robot::DriveSession& session, const Bounds& bounds,
                          const std::function<void(double)>& progress);

}  // namespace astro::motor
