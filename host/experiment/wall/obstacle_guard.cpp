#include "host/experiment/wall/obstacle_guard.hpp"

#include <cmath>

namespace astro::experiment {

double ObstacleGuard::excess_V(const WheelMoment& moment, std::size_t side) const {
  const double set_point_mps = moment.set_point_mps[side];
  const double usual_V = 2 * robot_.kS_V[side] + robot_.kV_Vspm[side] * std::abs(set_point_mps) +
                         robot_.kA_Vs2pm[side] * robot_.acceleration_mps2;
  return moment.voltage_V[side] * std::copysign(1.0, set_point_mps) - usual_V;
}

bool ObstacleGuard::is_held(const WheelMoment& moment, std::size_t side) const {
  constexpr double kBehind_mps = 0.12;  // more than a wheel lags behind its set point at full acceleration
  const double forward = std::copysign(1.0, moment.set_point_mps[side]);
  return (moment.set_point_mps[side] - moment.speed_mps[side]) * forward > kBehind_mps;
}

void ObstacleGuard::look(const WheelMoment& moment) {
  for (std::size_t side = 0; side < 2; ++side) {
    const bool against = excess_V(moment, side) > push_V_ || is_held(moment, side);
    in_a_row_[side] = against ? in_a_row_[side] + 1 : 0;
    pushes_ = pushes_ || in_a_row_[side] >= kSamples;
  }
}

}  // namespace astro::experiment
