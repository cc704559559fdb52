#pragma once

#include "host/motor/model/loop.hpp"

/// PI gains for a wanted bandwidth of the speed loop.
///
/// Law      The feed-forward follows the set point; the loop corrects what the motor model does not describe.
///          So at each crossover the integral gain is the largest that leaves 60 degrees of phase margin
///          (least integral of the error after a load), held between a tenth of kp times the crossover
///          (below that it would hardly act as an integral) and kp times the crossover. kp then follows from
///          the gain of 1, and the crossover is chosen so that the closed loop is 3 dB down at the wanted
///          bandwidth.
/// Refused  bandwidths for which the lag of observer and tick leaves too little phase, or at which the encoder's
///          steps would cause more than 0.2 V rms on the motors.
namespace astro::motor {

struct DesignTask {
  MotorModel motor;  // of both wheels: they share kp and ki
  double observer_radps = 0;
  double count_m = 0;
  double bandwidth_radps = 0;  // 0: the one that gives the largest ki
  double tick_s = 1e-3;
};

struct Design {
  double kp = 0, ki = 0;  // V s/m, V/m
  Margins margins;
  double noise_V = 0;  // rms, from the steps of the encoder
  double largest_bandwidth_radps = 0;
};

/// Throws astro::Error, naming the largest bandwidth and what would allow more, if the wanted one is not
/// possible; also for a motor model whose kV or kA is not positive.
Design design_gains(const DesignTask& task);

}  // namespace astro::motor
