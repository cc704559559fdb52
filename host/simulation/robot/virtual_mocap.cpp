#include "host/simulation/robot/virtual_mocap.hpp"

namespace astro::simulation {

std::optional<recording::TruthSample> VirtualMocap::advance(std::uint64_t time_us, const sim::Pose& truth) {
  if (static_cast<double>(time_us) < due_us_) return std::nullopt;
  due_us_ += 1e6 / config_.rate_hz;
  recording::TruthSample sample;
  sample.time_us = static_cast<std::int64_t>(time_us);
  const Pose2 body = config_.origin * pose_of(truth) * Pose2{config_.ahead_m, config_.left_m, 0};
  sample.x_m = body.x_m + config_.position_sd_m * normal_(random_);
  sample.y_m = body.y_m + config_.position_sd_m * normal_(random_);
  sample.theta_rad = body.theta_rad + config_.heading_sd_rad * normal_(random_);
  return sample;
}

}  // namespace astro::simulation
