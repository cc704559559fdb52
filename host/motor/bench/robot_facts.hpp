#pragma once

#include <array>

#include "host/motor/model/design.hpp"
#include "host/motor/model/prediction.hpp"
#include "host/motor/model/wiring.hpp"
#include "host/robot/parameters/parameters.hpp"

namespace astro::motor {

/// A robot's parameters about its wheels and their control; left, right.
struct RobotFacts {
  std::array<double, 2> count_m{};  // travel of one count, wheel factors included
  double counts_per_motor_rev = 0, gear_ratio = 0, wheel_diameter_m = 0;
  motor::Polarities polarities;
  double kp = 0, ki = 0;
  std::array<motor::MotorModel, 2> feed_forward;
  double observer_radps = 0;
  double motor_voltage_max_V = 0, speed_limit_mps = 0, acceleration_limit_mps2 = 0;

  double counts_per_turn() const { return counts_per_motor_rev * gear_ratio; }
};

/// Throws astro::Error where the robot lacks one of them.
RobotFacts facts_of(const robot::RemoteParameters& robot);

}  // namespace astro::motor
