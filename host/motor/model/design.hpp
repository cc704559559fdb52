#pragma once

#include <complex>

#include "host/motor/model/motor_model.hpp"

/// The speed loop of a wheel, and PI gains for a wanted bandwidth of it.
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

/// Why a loop cannot be designed. The last three are about a bandwidth. Their values are the wanted and the
/// largest possible bandwidth in Hz and, if there is one, the observer_bandwidth that would allow the wanted
/// one.
enum class DesignProblem { no_motor_model, encoder_too_coarse, encoder_rattles, observer_lags, tick_lags };

/// The wheel's speed loop as the firmware closes it, exactly as sampled: motor and wheel with the voltage
/// held for a tick, counts, the tracking observer, PI.
///
///   motor     dx(z) / V(z) = z^-1 (T (1 - g) + T g (1 - p) z^-1 / (1 - p z^-1)) / kV,
///             p = e^(-T/tau), tau = kA / kV, g = tau (1 - p) / T
///   observer  v(z) / dx(z) = a^2 / (1 - (1 - a) z^-1)^2 / T,   a = w T  (common/control/observer.hpp)
///   PI        u(z) / e(z) = kp + ki T z^-1 / (1 - z^-1)        (integrates after it acts)
///
/// At low frequency the observer is a lag of 2 / w: 10 ms at its default of 200 rad/s, far more than the
/// tick. Friction is not part of this model: the feed-forward compensates it, and the integral the rest.
struct SpeedLoop {
  MotorModel motor;
  double kp = 0, ki = 0;      // V s/m, V/m
  double observer_radps = 0;  // parameter observer_bandwidth
  double tick_s = 1e-3;
};

/// Transfer functions from voltage to observed speed and of the PI, at a frequency below pi / tick_s.
std::complex<double> plant_at(const SpeedLoop& loop, double omega_radps);
std::complex<double> controller_at(const SpeedLoop& loop, double omega_radps);

struct Margins {
  double crossover_radps = 0;   // the last at which the open loop's gain is 1
  double phase_margin_rad = 0;  // the least of all crossings
  double gain_margin = 0;       // factor on kp and ki together; infinite if there is none
  double bandwidth_radps = 0;   // observed speed over set point, without feed-forward, at -3 dB
  double sensitivity = 0;       // peak of |1 / (1 + L)|
};

/// Scans 600 frequencies per decade and interpolates the crossings. All 0 for a loop without gain.
Margins margins(const SpeedLoop& loop);

/// Rms of the observed speed while a wheel turns evenly, from the steps of the encoder alone: as if each were
/// off by white noise of a count / sqrt(12).
double quantisation_speed_mps(double observer_radps, double count_m, double tick_s = 1e-3);

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
