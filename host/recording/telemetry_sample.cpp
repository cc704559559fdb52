#include "host/recording/telemetry_sample.hpp"

#include <numbers>

namespace astro::recording {

OdometrySample to_sample(const protocol::Telemetry& telemetry) {
  constexpr double kMetre = 0x1p-40;
  constexpr double kTurn = 0x1p-64;
  OdometrySample sample;
  sample.time_us = static_cast<std::int64_t>(telemetry.device_time_us);
  sample.x_m = static_cast<double>(telemetry.pose.x) * kMetre;
  sample.y_m = static_cast<double>(telemetry.pose.y) * kMetre;
  sample.theta_rad =
      2 * std::numbers::pi * (telemetry.pose.turns + static_cast<double>(telemetry.pose.theta) * kTurn);
  sample.v_mps = telemetry.twist.v_umps * 1e-6;
  sample.omega_radps = telemetry.twist.omega_uradps * 1e-6;
  sample.left_counts = telemetry.counts.left;
  sample.right_counts = telemetry.counts.right;
  return sample;
}

}  // namespace astro::recording
