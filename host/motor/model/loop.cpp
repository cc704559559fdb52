#include "host/motor/model/loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace astro::motor {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

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

}  // namespace astro::motor
