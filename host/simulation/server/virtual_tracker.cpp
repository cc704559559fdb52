#include "host/simulation/server/virtual_tracker.hpp"

#include <cmath>

#include "host/simulation/robot/normal_deviates.hpp"

namespace astro::simulation {
namespace {

constexpr double kMarkers_m = 0.21;      // above the floor
constexpr double kHeightNoise_m = 2e-4;  // the same as in the plane
constexpr double kTilt_rad = 2e-3;

/// The pose turned about z, after small tilts about x and y.
truth::Pose3 pose_of(const recording::TruthSample& sample, double height_m, double tilt_x_rad,
                     double tilt_y_rad) {
  const double c = std::cos(sample.theta_rad / 2), s = std::sin(sample.theta_rad / 2);
  const double x = tilt_x_rad / 2, y = tilt_y_rad / 2, length = std::sqrt(1 + x * x + y * y);
  return {sample.x_m, sample.y_m, height_m, (c * x - s * y) / length, (c * y + s * x) / length,
          s / length, c / length};
}

}  // namespace

void VirtualTracker::take(std::int64_t now_us, const recording::TruthSample& sample) {
  ++frames_;
  NormalDeviates normal;
  const double height_m = kMarkers_m + kHeightNoise_m * normal(random_);
  const double tilt_x_rad = kTilt_rad * normal(random_), tilt_y_rad = kTilt_rad * normal(random_);
  const bool dropped = uniform(random_) < faults_.dropped;
  if (!dropped) waiting_.push_back({frames_, now_us, pose_of(sample, height_m, tilt_x_rad, tilt_y_rad)});
}

std::optional<TrackedFrame> VirtualTracker::next(std::int64_t now_us) {
  const auto latency_us = std::llround(1e6 * faults_.latency_s);
  if (waiting_.empty() || waiting_.front().exposed_us + latency_us > now_us) return std::nullopt;
  const TrackedFrame frame = waiting_.front();
  waiting_.pop_front();
  return frame;
}

}  // namespace astro::simulation
