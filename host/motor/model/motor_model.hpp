#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/base/side.hpp"

/// The motor model of a wheel, from samples of its voltage and its position:
///
///   V = kS sign(v) + kV v + kA dv/dt
///
/// the firmware's own feed-forward (common/control/wheel_controller.hpp).
///
/// Estimator  Counts are not differentiated. The equation is multiplied by a smooth bump phi that vanishes at
///            both ends of a window together with its slope, and integrated by parts:
///
///              [phi V] = kS [phi sign(v)] - kV [phi' x] + kA [phi'' x],   [.] the integral over the window
///
///            so the position enters as it was counted, and a constant offset of it (the half count that
///            rounding down loses) has no effect.
/// Unbiased   The encoder's steps are noise in the regressors, which biases kA low in least squares (with
///            windows of 60 ms by 2 % for ASTRO, by 16 % with an eighth of its counts). The voltage is known
///            without noise, so a wheel that obeys the model under the same voltages gives instruments: five
///            rounds, each with the model of the round before.
/// Windows    Only those in which the wheel turns one way from end to end and the motor drives: a gear loses
///            torque in proportion to what it passes on, so a wheel that brakes follows another law.
/// Source     modulating functions: Shinbrot, Trans. ASME 79 (1957); instruments from a model: Young,
///            Automatica 6 (1970).
namespace astro::motor {

/// Why the samples of a wheel give no model.
enum class MotorProblem { does_not_follow, turned_too_little };

/// One wheel at one control tick. The voltage is on the motor from this sample to the next.
struct Sample {
  double time_s = 0;
  double voltage_V = 0;   // duty times supply, forward positive
  double position_m = 0;  // counts times travel per count: it goes in steps
};

struct MotorModel {
  double kS = 0;  // V
  double kV = 0;  // V s/m
  double kA = 0;  // V s^2/m

  double time_constant_s() const { return kA / kV; }
};

/// One window: means weighted with the bump function phi.
struct Window {
  double voltage_V = 0, sense = 0, speed_mps = 0, acceleration_mps2 = 0;
};

struct MotorFit {
  MotorModel model, standard_error;
  double residual_V = 0;  // rms
  double r_squared = 0;
  std::vector<Window> windows;  // the windows that were fitted
};

/// `count_m`: travel of one count. Samples in order of time, at any rate that gives the wheel's time constant
/// ten samples; may hold several drives.
///
/// Standard errors allow for correlation between neighbouring windows (Newey and West).
/// Throws astro::Error, one clause without a subject ("turned too little ..."), if the data do not determine a
/// model.
MotorFit fit_motor(std::span<const Sample> samples, double count_m);

/// Voltage at which a wheel that stood began to turn, while the voltage rose slowly from zero; with the sign
/// of the motion. nullopt if it did not turn.
std::optional<double> breakaway_V(std::span<const Sample> rise, double count_m);

}  // namespace astro::motor
