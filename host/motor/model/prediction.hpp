#pragma once

#include <span>
#include <vector>

#include "host/motor/model/motor_model.hpp"

/// Predicts the response of the firmware's speed loop to a course of set points, in double precision: motor with
/// dry friction, encoder steps, observer, feed-forward, PI with anti-windup, voltage limit. It deliberately does
/// not call common/control, so that a comparison of measured and predicted responses tests both.
namespace astro::motor {

struct WheelLoop {
  MotorModel motor;
  double breakaway_V = 0;   // below this a standing wheel does not turn; at least kS
  MotorModel feed_forward;  // that is or would be loaded in the robot
  double kp = 0, ki = 0;    // V s/m, V/m
  double observer_radps = 0;
  double limit_V = 0;  // the least of supply and motor_voltage_max
  double count_m = 0;
  double tick_s = 1e-3;
};

struct Predicted {
  double set_point_mps = 0, observed_mps = 0, true_mps = 0, voltage_V = 0;
};

/// One element per tick, from rest. `set_points_mps`: after limits and shaping, one per tick; the feed-forward
/// takes the acceleration from their differences.
std::vector<Predicted> predict(const WheelLoop& loop, std::span<const double> set_points_mps);

/// The usual figures of a step response.
struct StepFigures {
  double rise_s = 0;           // from 10 % to 90 % of the final set point; NaN if it is never reached
  double overshoot = 0;        // peak over final set point, minus one; not below 0
  double worst_error_mps = 0;  // of speed against set point, at any time
  double rms_error_mps = 0;
};

/// Series of equal length: times in order, set points and speeds. The final set point is the last.
StepFigures step_figures(std::span<const double> time_s, std::span<const double> set_point_mps,
                         std::span<const double> speed_mps);

}  // namespace astro::motor
