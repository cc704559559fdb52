#include "host/commands/shared/path_progress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace astro::commands {
namespace {

constexpr double kHalfTrack_m = 0.15;  // of a robot of usual size; only the bar's evenness depends on it

double outer_wheel_m(double length_m, double angle_rad) {
  return std::abs(length_m) + kHalfTrack_m * std::abs(angle_rad);
}

}  // namespace

PathProgress::PathProgress(const robot::Path& path) {
  double end_m = 0;
  for (const protocol::AddSegment& segment : path) {
    const double angle_rad = 2 * std::numbers::pi * std::ldexp(static_cast<double>(segment.angle), -32);
    end_m += outer_wheel_m(static_cast<double>(segment.length_nm) * 1e-9, angle_rad);
    ends_m_.push_back(end_m);
  }
}

void PathProgress::moved_to(const recording::OdometrySample& sample) {
  if (started_)
    driven_m_ += outer_wheel_m(std::hypot(sample.x_m - last_.x_m, sample.y_m - last_.y_m),
                               sample.theta_rad - last_.theta_rad);
  last_ = sample;
  started_ = true;
  if (done_ < ends_m_.size()) driven_m_ = std::min(driven_m_, ends_m_[done_]);
}

void PathProgress::segment_done(std::uint16_t tag) {
  done_ = std::min<std::size_t>(tag, ends_m_.size());
  if (done_ > 0) driven_m_ = std::max(driven_m_, ends_m_[done_ - 1]);
}

double PathProgress::fraction() const {
  return ends_m_.empty() || ends_m_.back() == 0 ? 1 : driven_m_ / ends_m_.back();
}

}  // namespace astro::commands
