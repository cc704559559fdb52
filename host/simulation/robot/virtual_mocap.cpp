#include "host/simulation/robot/virtual_mocap.hpp"

#include <cmath>

namespace astro::simulation {

VirtualMocap::VirtualMocap(const MocapConfig& config)
    : config_(config),
      cos_(std::cos(config.origin_theta_rad)),
      sin_(std::sin(config.origin_theta_rad)),
      random_(config.seed) {}

std::optional<recording::TruthSample> VirtualMocap::advance(std::uint64_t time_us, const sim::Pose& truth) {
  if (static_cast<double>(time_us) < due_us_) return std::nullopt;
  due_us_ += 1e6 / config_.rate_hz;
  recording::TruthSample sample;
  sample.time_us = static_cast<std::int64_t>(time_us);
  const double c = std::cos(truth.theta_rad), s = std::sin(truth.theta_rad);
  const double x_m = truth.x_m + (c * config_.ahead_m - s * config_.left_m);
  const double y_m = truth.y_m + (s * config_.ahead_m + c * config_.left_m);
  sample.x_m = config_.origin_x_m + cos_ * x_m - sin_ * y_m + config_.position_sd_m * normal_(random_);
  sample.y_m = config_.origin_y_m + sin_ * x_m + cos_ * y_m + config_.position_sd_m * normal_(random_);
  sample.theta_rad = config_.origin_theta_rad + truth.theta_rad + config_.heading_sd_rad * normal_(random_);
  return sample;
}

}  // namespace astro::simulation
