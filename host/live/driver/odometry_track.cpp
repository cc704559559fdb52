#include "host/live/driver/odometry_track.hpp"

#include <cmath>

#include "common/fixed/wrapping.hpp"
#include "host/calibration/motion/arc.hpp"

namespace astro::live {

using calibration::Symmetric3;

namespace {

/// The path between two consecutive samples is an arc. If a pose is further than this from the end of the arc, somebody has
/// set it.
constexpr double kJump_m = 0.02, kJump_rad = 0.05;
constexpr double kGap_s = 0.25;       // after a longer gap the path is not known
constexpr double kBeyondLimit = 1.5;  // a robot that overshoots its limits, or is pushed

}  // namespace

void OdometryTrack::set_geometry(const OdometryGeometry& geometry) {
  const Symmetric3 start = uncertainty_ ? uncertainty_->covariance() : Symmetric3{};
  geometry_ = geometry;
  errors_ = stated_errors_.value_or(uncalibrated_errors(geometry.factors.b_m));
  uncertainty_.emplace(geometry.factors, errors_);
  uncertainty_->restart(heading_rad_.value_or(0), start);
}

void OdometryTrack::restart(double heading_rad, const Symmetric3& start) {
  heading_rad_ = heading_rad;
  last_.reset();
  if (uncertainty_) uncertainty_->restart(heading_rad, start);
}

bool OdometryTrack::take(const recording::OdometrySample& sample) {
  bool follows_wheels = true;
  if (last_) {
    const auto right = wrapping_difference(sample.right_counts, last_->right_counts);
    const auto left = wrapping_difference(sample.left_counts, last_->left_counts);
    right_counts_ += right;
    left_counts_ += left;
    follows_wheels = follows(sample, geometry_.count_m * right, geometry_.count_m * left);
    if (follows_wheels) uncertainty_->travel(geometry_.count_m * right, geometry_.count_m * left);
  }
  if (!heading_rad_ || !follows_wheels) uncertainty_->restart(sample.theta_rad);
  heading_rad_ = sample.theta_rad;
  last_ = sample;
  return follows_wheels;
}

bool OdometryTrack::follows(const recording::OdometrySample& sample, double right_m, double left_m) const {
  const double gap_s = 1e-6 * static_cast<double>(sample.time_us - last_->time_us);
  Pose2 expected = pose_of(*last_);
  calibration::advance(expected, right_m, left_m, geometry_.factors);
  const double turn_rad = wrapped_rad(sample.theta_rad - expected.theta_rad);
  if (std::abs(turn_rad) >= kJump_rad + possible_turn_rad(gap_s)) return false;
  if (gap_s > kGap_s) expected = pose_of(*last_);
  return std::hypot(sample.x_m - expected.x_m, sample.y_m - expected.y_m) < kJump_m + possible_way_m(gap_s);
}

/// How far a robot can be from its last position after a gap; 0 after a short gap, in which it follows the arc.
double OdometryTrack::possible_way_m(double gap_s) const {
  return gap_s > kGap_s ? kBeyondLimit * geometry_.fastest_mps * gap_s : 0;
}

/// How far the heading can differ from that of the counts. Counts determine the heading whatever the path is, unless the
/// wheelbase depends on the curvature (e is not 0).
double OdometryTrack::possible_turn_rad(double gap_s) const {
  if (geometry_.factors.e == 0 || gap_s <= kGap_s) return 0;
  return kBeyondLimit * std::abs(geometry_.factors.e) * geometry_.fastest_radps * gap_s;
}

Symmetric3 OdometryTrack::covariance() const {
  const double count_variance = geometry_.count_m * geometry_.count_m / 12, b_m = geometry_.factors.b_m;
  const Symmetric3 counts{count_variance / 2, 0, 0, count_variance / 2, 0, 2 * count_variance / (b_m * b_m)};
  return counts + uncertainty_->covariance();
}

}  // namespace astro::live
