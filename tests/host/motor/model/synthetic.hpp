#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "host/motor/model/motor_model.hpp"

/// A wheel that obeys the model exactly, seen through an encoder.
namespace astro::motor {

struct SyntheticWheel {
  MotorModel motor{0.48, 12.2, 1.08};
  double breakaway_V = 1.0;
  double count_m = 8.07e-5;
  double noise_V = 0;      // white per 10 ms: torque ripple
  double period_s = 1e-3;  // of the samples
  unsigned seed = 1;
};

inline std::vector<Sample> drive(const SyntheticWheel& wheel, double seconds,
                                 const std::function<double(double)>& voltage_V) {
  std::mt19937 random(wheel.seed);
  std::normal_distribution<double> ripple(0, wheel.noise_V > 0 ? wheel.noise_V : 1);
  std::uniform_real_distribution<double> anywhere(0, 1);
  constexpr double kStep_s = 1e-4;
  const double start = anywhere(random);
  double speed = 0, position = 0, disturbance = 0;
  std::vector<Sample> samples;
  const int steps = static_cast<int>(std::lround(seconds / kStep_s));
  const int per_sample = static_cast<int>(std::lround(wheel.period_s / kStep_s));
  double held_V = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = i * kStep_s;
    if (i % per_sample == 0) {
      held_V = voltage_V(t);
      samples.push_back({t, held_V, std::floor(position / wheel.count_m + start) * wheel.count_m});
    }
    if (i % 100 == 0) disturbance = wheel.noise_V > 0 ? ripple(random) : 0;
    const double V = held_V + disturbance;
    if (speed == 0 && std::abs(V) <= wheel.breakaway_V) continue;
    const double sense = speed != 0 ? speed : V;
    const double change =
        (V - std::copysign(wheel.motor.kS, sense) - wheel.motor.kV * speed) / wheel.motor.kA * kStep_s;
    const double next = (speed + change) * sense < 0 ? 0 : speed + change;
    position += (speed + next) / 2 * kStep_s;
    speed = next;
  }
  return samples;
}

/// Up and down slowly, both ways, and four steps: 16 s.
inline double excitation_V(double t) {
  const auto triangle = [](double at) { return at < 2.5 ? 1.6 * at : 1.6 * (5 - at); };
  if (t < 5) return triangle(t);
  if (t < 10) return -triangle(t - 5);
  const double phase = std::fmod(t - 10, 1.5);
  if (phase > 0.7) return 0;
  return (static_cast<int>((t - 10) / 1.5) % 2 == 0 ? 1 : -1) * (t < 13 ? 4.0 : 2.5);
}

}  // namespace astro::motor
