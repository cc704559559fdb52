#pragma once

#include <functional>
#include <optional>

#include "host/motor/bench/bench.hpp"
#include "host/motor/model/roll.hpp"

/// Records what the wheels count while a person rolls the robot by hand, with its bridges open.
namespace astro::motor {

/// Waits until the wheels have turned and then stood still for two seconds. `idle` is called at least every
/// 50 ms; an exception of it ends the wait. Throws astro::Error if nobody rolls the robot for a minute.
void wait_for_roll(Bench& bench, const Moment& start, const std::function<void()>& idle);

/// How far a robot was rolled: one of them was measured.
struct RolledLength {
  std::optional<double> distance_m = {}, turns = {};  // turns: of a wheel
};

/// The counts since `start` with the robot's parameters.
Roll roll_since(Bench& bench, const Moment& start, const RolledLength& length);

}  // namespace astro::motor
