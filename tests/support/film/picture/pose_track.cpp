#include "tests/support/film/picture/pose_track.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace astro::support::film {

FloorPose compose(const FloorPose& outer, const FloorPose& inner) {
  const double c = std::cos(outer.theta_rad), s = std::sin(outer.theta_rad);
  return {outer.x_m + c * inner.x_m - s * inner.y_m, outer.y_m + s * inner.x_m + c * inner.y_m,
          outer.theta_rad + inner.theta_rad};
}

PoseTrack::PoseTrack(double begin_s, double interval_s, std::vector<FloorPose> poses)
    : begin_s_(begin_s), interval_s_(interval_s), poses_(std::move(poses)) {
  if (poses_.empty() || !(interval_s > 0)) throw std::logic_error("a track without poses or interval");
}

FloorPose PoseTrack::at(double time_s) const {
  const double last = static_cast<double>(poses_.size() - 1);
  const double place = std::clamp((time_s - begin_s_) / interval_s_, 0.0, last);
  const double whole = std::min(std::floor(place), std::max(last - 1, 0.0));
  const FloorPose& a = poses_[static_cast<std::size_t>(whole)];
  const FloorPose& b = poses_[std::min(static_cast<std::size_t>(whole) + 1, poses_.size() - 1)];
  const double part = place - whole;
  return {a.x_m + part * (b.x_m - a.x_m), a.y_m + part * (b.y_m - a.y_m),
          a.theta_rad + part * (b.theta_rad - a.theta_rad)};
}

}  // namespace astro::support::film
