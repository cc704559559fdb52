#pragma once

#include <span>
#include <vector>

#include "host/motor/model/motor_model.hpp"

/// What the firmware's speed loop will make of a course of set points, in double precision: motor with dry
/// friction, encoder steps, observer, feed-forward and PI with its anti-windup, voltage limit. A second
/// writing of common/control, on purpose: measured against predicted is then a test of both.
namespace astro::motor {

struct WheelLoop {
  MotorModel motor;
  double breakaway_V = 0;   // holds a wheel that stands; at least kS
  MotorModel feed_forward;  // what the robot carries or would carry
  double kp = 0, ki = 0;    // V s/m, V/m
  double observer_radps = 0;
  double limit_V = 0;  // the least of supply and motor_voltage_max
  double count_m = 0;
  double tick_s = 1e-3;
};

struct Predicted {
  double set_point_mps = 0, observed_mps = 0, true_mps = 0, voltage_V = 0;
};

/// One element a tick, from rest. `set_points_mps`: as limits and shaping leave them, one a tick; the
/// feed-forward takes the acceleration from their differences.
std::vector<Predicted> predict(const WheelLoop& loop, std::span<const double> set_points_mps);

}  // namespace astro::motor
