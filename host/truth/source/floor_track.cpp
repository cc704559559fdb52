#include "host/truth/source/floor_track.hpp"

#include <utility>

namespace astro::truth {

recording::TruthSample FloorTrack::take(std::int64_t time_us, const Pose3& pose, bool tracked) {
  const bool repeated = std::exchange(last_, pose) == pose;
  recording::TruthSample sample;
  sample.time_us = time_us;
  sample.valid = tracked && !repeated && is_possible(pose);
  sample.theta_rad = theta_rad_;
  if (!sample.valid) return sample;
  const Pose2 floor = on_floor(pose, up_);
  sample.x_m = floor.x_m;
  sample.y_m = floor.y_m;
  theta_rad_ += wrapped_rad(floor.theta_rad - theta_rad_);
  sample.theta_rad = theta_rad_;
  return sample;
}

}  // namespace astro::truth
