#include "host/motor/model/step_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace astro::motor {
namespace {

double time_of(std::span<const double> time_s, std::span<const double> speed_mps, double level_mps) {
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (speed_mps[i] * level_mps <= 0 || std::abs(speed_mps[i]) < std::abs(level_mps)) continue;
    if (i == 0) return time_s[0];
    const double part = (level_mps - speed_mps[i - 1]) / (speed_mps[i] - speed_mps[i - 1]);
    return time_s[i - 1] + part * (time_s[i] - time_s[i - 1]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

StepFigures step_figures(std::span<const double> time_s, std::span<const double> set_point_mps,
                         std::span<const double> speed_mps) {
  StepFigures figures;
  if (time_s.empty()) return figures;
  const double goal_mps = set_point_mps.back();
  figures.rise_s = time_of(time_s, speed_mps, 0.9 * goal_mps) - time_of(time_s, speed_mps, 0.1 * goal_mps);
  double squares = 0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double error_mps = speed_mps[i] - set_point_mps[i];
    squares += error_mps * error_mps;
    figures.worst_error_mps = std::max(figures.worst_error_mps, std::abs(error_mps));
    figures.overshoot = std::max(figures.overshoot, speed_mps[i] / goal_mps - 1);
  }
  figures.rms_error_mps = std::sqrt(squares / static_cast<double>(time_s.size()));
  return figures;
}

}  // namespace astro::motor
