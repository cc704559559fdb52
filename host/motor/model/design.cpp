#include "host/motor/model/design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"

namespace astro::motor {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;
constexpr double kPhaseMargin_rad = pi / 3;
constexpr double kLeastIntegral = 0.1, kMostIntegral = 1.0;  // of kp times the crossover
constexpr double kMostNoise_V = 0.2;  // a fifth of what makes a motor of this kind turn
constexpr double kLeastCrossover_radps = 0.1, kMostObserver_radps = 500;  // the parameter's own limit

Complex delay_at(const SpeedLoop& loop, double omega_radps) {
  return std::polar(1.0, -omega_radps * loop.tick_s);
}

// The phase of the open loop without jumps: it begins at -90 or -180 degrees (an integrator) and only falls.
double unwound(double phase) { return phase > pi / 4 ? phase - 2 * pi : phase; }

struct Point {
  double omega_radps;
  Complex open;
};

void note_crossings(const Point& before, const Point& now, Margins& found) {
  const double was = std::abs(before.open), is = std::abs(now.open);
  const double was_phase = unwound(std::arg(before.open)), phase = unwound(std::arg(now.open));
  if ((was - 1) * (is - 1) < 0) {
    const double part = std::log(was) / std::log(was / is);
    found.crossover_radps = before.omega_radps * std::pow(now.omega_radps / before.omega_radps, part);
    found.phase_margin_rad = std::min(found.phase_margin_rad, pi + phase);
  }
  if (was_phase > -pi && phase <= -pi) found.gain_margin = std::min(found.gain_margin, 1 / is);
}

double hertz(double radps) { return radps / (2 * pi); }

enum class Limit { none, phase, noise };

struct Attempt {
  double kp = 0, ki = 0;
  Limit limit = Limit::none;
};

Attempt at_crossover(const DesignTask& task, double crossover_radps) {
  const SpeedLoop loop{task.motor, 0, 0, task.observer_radps, task.tick_s};
  const std::complex<double> plant = plant_at(loop, crossover_radps);
  double phase = std::arg(plant);
  if (phase > 0) phase -= 2 * pi;
  // The phase lag that the PI may have, held within its limits.
  const double room = pi + phase - kPhaseMargin_rad;
  const double lag = std::clamp(room, std::atan(kLeastIntegral), std::atan(kMostIntegral));
  // kp + ki T / (z - 1) with 1 / (z - 1) = -1/2 - j / (2 tan(w T / 2))
  const double gain = 1 / std::abs(plant), half = crossover_radps * task.tick_s / 2;
  Attempt attempt;
  attempt.ki = gain * std::sin(lag) * 2 * std::tan(half) / task.tick_s;
  attempt.kp = gain * std::cos(lag) + attempt.ki * task.tick_s / 2;
  if (room < lag) attempt.limit = Limit::phase;
  const double noise_V = attempt.kp * quantisation_speed_mps(task.observer_radps, task.count_m, task.tick_s);
  if (noise_V > kMostNoise_V && attempt.limit == Limit::none) attempt.limit = Limit::noise;
  return attempt;
}

Design finished(const DesignTask& task, double crossover_radps) {
  const Attempt attempt = at_crossover(task, crossover_radps);
  Design design{attempt.kp, attempt.ki, {}, 0, 0};
  design.margins = margins({task.motor, attempt.kp, attempt.ki, task.observer_radps, task.tick_s});
  design.noise_V = attempt.kp * quantisation_speed_mps(task.observer_radps, task.count_m, task.tick_s);
  return design;
}

double bandwidth_at(const DesignTask& task, double crossover_radps) {
  return finished(task, crossover_radps).margins.bandwidth_radps;
}

struct Largest {
  double crossover_radps = 0;
  Limit because = Limit::none;
};

// Phase and noise allow every crossover up to this one, because both only get worse with frequency.
Largest largest_crossover(const DesignTask& task) {
  double low = kLeastCrossover_radps, high = 0.5 * pi / task.tick_s;
  Limit because = at_crossover(task, low).limit;
  if (because != Limit::none) return {0, because};
  for (int i = 0; i < 50; ++i) {
    const double middle = std::sqrt(low * high);
    const Limit limit = at_crossover(task, middle).limit;
    if (limit != Limit::none) because = limit;
    (limit == Limit::none ? low : high) = middle;
  }
  return {low, because};
}

// The slowest observer bandwidth, in whole tens, that allows the wanted bandwidth; nullopt if none does.
std::optional<double> observer_for(DesignTask task) {
  for (double observer = 10 * std::ceil(task.observer_radps / 10 + 1e-9); observer <= kMostObserver_radps;
       observer += 10) {
    task.observer_radps = observer;
    const Largest largest = largest_crossover(task);
    if (largest.crossover_radps > 0 && bandwidth_at(task, largest.crossover_radps) >= task.bandwidth_radps)
      return observer;
  }
  return std::nullopt;
}

struct Reason {
  DesignProblem problem;
  const char* words;
};

Reason reason_of(Limit because, bool observer_helps) {
  if (because == Limit::noise)
    return {DesignProblem::encoder_rattles, "the steps of the encoder would rattle the motors"};
  if (observer_helps) return {DesignProblem::observer_lags, "the wheel speed observer lags too much for it"};
  return {DesignProblem::tick_lags, "the observer and the tick of 1 ms lag too much for it"};
}

[[noreturn]] void refuse(const DesignTask& task, double largest_radps, Limit because) {
  const auto observer = observer_for(task);
  const Reason reason = reason_of(because, observer.has_value());
  std::vector<std::string> values{fmt::format("{:.3g}", hertz(task.bandwidth_radps)),
                                  fmt::format("{:.1f}", hertz(largest_radps))};
  std::string sentence = fmt::format("a bandwidth of {} Hz is too much, {}: at most {} Hz are possible",
                                     values[0], reason.words, values[1]);
  if (observer) {
    values.push_back(fmt::format("{:.0f}", *observer));
    sentence += "; an observer_bandwidth of " + values[2] + " rad/s would allow it";
  }
  throw Error(sentence, reason.problem, std::move(values));
}

double crossover_for(const DesignTask& task, double largest_radps) {
  double low = kLeastCrossover_radps, high = largest_radps;
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(low * high);
    (bandwidth_at(task, middle) < task.bandwidth_radps ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

// The crossover with the largest integral gain: a load displaces the wheel by its force over ki.
double stiffest_crossover(const DesignTask& task, double largest_radps) {
  constexpr int kTrials = 60;
  double best_radps = largest_radps, most = 0;
  for (int i = 1; i <= kTrials; ++i) {
    const double crossover_radps = largest_radps * i / kTrials;
    const double ki = at_crossover(task, crossover_radps).ki;
    if (ki <= most) continue;
    most = ki;
    best_radps = crossover_radps;
  }
  return best_radps;
}

}  // namespace

Complex plant_at(const SpeedLoop& loop, double omega_radps) {
  const Complex z1 = delay_at(loop, omega_radps);
  const double tau_s = loop.motor.time_constant_s(), p = std::exp(-loop.tick_s / tau_s);
  const double g = tau_s * (1 - p) / loop.tick_s;
  const Complex step = z1 * ((1 - g) + g * (1 - p) * z1 / (1.0 - p * z1)) / loop.motor.kV;  // m/s a tick
  const double a = loop.observer_radps * loop.tick_s;
  const Complex lag = 1.0 - (1 - a) * z1;
  return step * a * a / (lag * lag);
}

Complex controller_at(const SpeedLoop& loop, double omega_radps) {
  const Complex z1 = delay_at(loop, omega_radps);
  return loop.kp + loop.ki * loop.tick_s * z1 / (1.0 - z1);
}

Margins margins(const SpeedLoop& loop) {
  if (loop.kp == 0 && loop.ki == 0) return {};
  constexpr int kPerDecade = 600;
  const double infinite = std::numeric_limits<double>::infinity();
  const double last = std::log10(pi / loop.tick_s * 0.999);
  Margins found{0, infinite, infinite, 0, 0};
  Point before{};
  for (int i = 0;; ++i) {
    const double decade = -2 + static_cast<double>(i) / kPerDecade;
    if (decade > last) return found;
    const double omega = std::pow(10.0, decade);
    const Point now{omega, plant_at(loop, omega) * controller_at(loop, omega)};
    found.sensitivity = std::max(found.sensitivity, std::abs(1.0 / (1.0 + now.open)));
    const double closed = std::abs(now.open / (1.0 + now.open));
    if (found.bandwidth_radps == 0 && closed < std::numbers::sqrt2 / 2) found.bandwidth_radps = omega;
    if (i > 0) note_crossings(before, now, found);
    before = now;
  }
}

double quantisation_speed_mps(double observer_radps, double count_m, double tick_s) {
  // Impulse response of position to speed: the derivative of two equal lags.
  const double a = observer_radps * tick_s, keep = 1 - a;
  double sum = 0, before = 0, power = 1;
  for (int n = 0; n < 100'000 && power > 1e-12; ++n, power *= keep) {
    const double now = a * a * (n + 1) * power;
    sum += (now - before) * (now - before);
    before = now;
  }
  return count_m / tick_s * std::sqrt(sum / 12);
}

Design design_gains(const DesignTask& wanted) {
  DesignTask task = wanted;
  if (!(task.motor.kV > 0) || !(task.motor.kA > 0))
    throw Error("the measured motor model has no positive kV and kA: measure again with more voltage",
                DesignProblem::no_motor_model);
  const Largest largest = largest_crossover(task);
  if (largest.crossover_radps == 0)
    throw Error("the encoder is too coarse for any speed loop with this observer: lower observer_bandwidth",
                DesignProblem::encoder_too_coarse);
  // Rounded down, so that the figure in the refusal is itself accepted.
  const double most_radps = bandwidth_at(task, largest.crossover_radps);
  if (task.bandwidth_radps == 0) {
    Design design = finished(task, stiffest_crossover(task, largest.crossover_radps));
    design.largest_bandwidth_radps = most_radps;
    return design;
  }
  if (task.bandwidth_radps > 1.002 * most_radps)
    refuse(task, std::floor(hertz(most_radps) * 10) / 10 * 2 * pi, largest.because);
  Design design = finished(task, crossover_for(task, largest.crossover_radps));
  design.largest_bandwidth_radps = most_radps;
  return design;
}

}  // namespace astro::motor
