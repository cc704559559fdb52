#include "host/live/driver/continuous_odometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/fixed/wrapping.hpp"
#include "host/base/error.hpp"
#include "host/calibration/motion/arc.hpp"
#include "host/recording/telemetry_sample.hpp"

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
  // The robot then begins its pose with the gyro anew, where the wheels' is.
  if (geometry.gyro_settings != geometry_.gyro_settings) gyro_heading_rad_.reset();
  geometry_ = geometry;
  errors_ = stated_errors_.value_or(uncalibrated_errors(geometry.factors.b_m));
  uncertainty_.emplace(geometry.factors, errors_);
  uncertainty_->restart(heading_rad_.value_or(0), start);
  const Symmetric3 gyro_start = gyro_uncertainty_ ? gyro_uncertainty_->covariance() : start;
  gyro_uncertainty_.emplace(geometry.factors, errors_, geometry.gyro);
  gyro_uncertainty_->restart(gyro_heading_rad_.value_or(heading_rad_.value_or(0)), gyro_start);
}

void OdometryTrack::restart(double heading_rad, const Symmetric3& start) {
  heading_rad_ = heading_rad;
  last_.reset();
  gyro_heading_rad_.reset();
  if (uncertainty_) uncertainty_->restart(heading_rad, start);
  if (gyro_uncertainty_) gyro_uncertainty_->restart(heading_rad, start);
}

bool OdometryTrack::take(const recording::OdometrySample& sample) {
  bool follows_wheels = true;
  step_ = {};
  if (last_) {
    const auto right = wrapping_difference(sample.right_counts, last_->right_counts);
    const auto left = wrapping_difference(sample.left_counts, last_->left_counts);
    right_counts_ += right;
    left_counts_ += left;
    step_ = {.right_m = geometry_.count_m * right,
             .left_m = geometry_.count_m * left,
             .time_s = 1e-6 * static_cast<double>(sample.time_us - last_->time_us)};
    follows_wheels = follows(sample, step_.right_m, step_.left_m);
    if (follows_wheels) uncertainty_->travel(step_.right_m, step_.left_m);
  }
  if (!heading_rad_ || !follows_wheels) {
    uncertainty_->restart(sample.theta_rad);
    gyro_uncertainty_->restart(sample.theta_rad);
    gyro_heading_rad_.reset();
  }
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

void OdometryTrack::take_gyro(const std::optional<recording::GyroPose>& pose, protocol::GyroState state) {
  if (!pose) return gyro_heading_rad_.reset();
  if (gyro_heading_rad_) {
    step_.turn_rad = pose->theta_rad - *gyro_heading_rad_;
    step_.gyro_counts = state == protocol::GyroState::running;
    step_.saturated = state == protocol::GyroState::saturated;
    gyro_uncertainty_->advance(step_);
  } else {
    gyro_uncertainty_->restart(pose->theta_rad, uncertainty_->covariance());
  }
  gyro_heading_rad_ = pose->theta_rad;
}

Symmetric3 OdometryTrack::counts_covariance() const {
  const double count_variance = geometry_.count_m * geometry_.count_m / 12, b_m = geometry_.factors.b_m;
  return {count_variance / 2, 0, 0, count_variance / 2, 0, 2 * count_variance / (b_m * b_m)};
}

Symmetric3 OdometryTrack::covariance() const { return counts_covariance() + uncertainty_->covariance(); }

namespace {

constexpr double kFarthest_m = 4e6;  // what the robot can hold

std::int64_t position(double metres) {
  if (!(std::abs(metres) <= kFarthest_m)) throw Error("a position must be a number within 4000 km");
  return std::llround(std::ldexp(metres, 40));
}

/// 2^-64 turn.
std::uint64_t angle(double theta_rad) {
  const double turns = theta_rad / (2 * std::numbers::pi);
  return static_cast<std::uint64_t>(std::ldexp(turns - std::floor(turns), 64));
}

double in_seconds(microseconds time) { return 1e-6 * static_cast<double>(time.count()); }

}  // namespace

void ContinuousOdometry::begin(RobotSession& session, bool restarted) {
  note_parameters(session);
  restarted_ = restarted_ || restarted;
  first_ = true;
  ignore_until_us_ = 0;
}

void ContinuousOdometry::note_parameters(RobotSession& session) {
  track_.set_geometry(OdometryGeometry::of(session.numbers()));
}

void ContinuousOdometry::set_pose(RobotSession& session, const Pose2& pose, const Symmetric3& covariance) {
  if (!std::isfinite(pose.theta_rad)) throw Error("a heading must be a number");
  unanswered_.reset();
  try {
    put(session, {position(pose.x_m), position(pose.y_m), angle(pose.theta_rad)}, pose.theta_rad, covariance);
  } catch (const robot::LinkLost&) {
    unanswered_ = {pose, covariance};
    throw;
  }
  restoring_ = false;
  event_ = "the pose was set";
}

void ContinuousOdometry::put(RobotSession& session, const protocol::SetPose& pose, double theta_rad,
                             const Symmetric3& covariance) {
  session.ask(pose);
  track_.restart(theta_rad, covariance);  // at once, because the next request may lose the link
  // A sample may be under way that is older than the answer.
  ignore_until_us_ = session.device_now_us();
}

bool ContinuousOdometry::take(RobotSession& session, const protocol::Telemetry& telemetry) {
  if (telemetry.device_time_us <= ignore_until_us_) return false;
  if (std::exchange(first_, false) && pose_) restoring_ = has_restarted(session, telemetry);
  if (restoring_) {
    restore(session, telemetry);
    return false;
  }
  restarted_ = false;
  sample_ = recording::to_sample(telemetry);
  settle_unanswered();
  if (!track_.take(sample_)) event_ = "another program has set the pose";
  track_.take_gyro(recording::gyro_pose(telemetry), telemetry.fused.gyro);
  pose_ = telemetry.pose;
  seen_at_ = session.client().now();
  seen_device_us_ = telemetry.device_time_us;
  return true;
}

/// If the robot has taken the pose, it still stands there, because it takes none while it moves and nobody has armed it
/// since.
void ContinuousOdometry::settle_unanswered() {
  constexpr double kThere_m = 1e-3, kThere_rad = 5e-3;  // flickering counts
  const auto put = std::exchange(unanswered_, std::nullopt);
  if (!put) return;
  const Pose2 off = difference(pose_of(sample_), put->pose);
  if (std::hypot(off.x_m, off.y_m) > kThere_m || std::abs(off.theta_rad) > kThere_rad) return;
  track_.restart(put->pose.theta_rad, put->covariance);
  event_ = "the pose was set";
}

/// If the robot has restarted, its clock is behind the expected time. This test fails if this computer was suspended
/// meanwhile, because its own clock then stood still. So it also counts as a restart if counts and pose are all zero and were
/// not before.
bool ContinuousOdometry::has_restarted(RobotSession& session, const protocol::Telemetry& telemetry) const {
  constexpr double kSlowest = 0.999,
                   kLate_s = 0.5;  // ten times worse than a poor crystal; a sample that waited
  const recording::OdometrySample now = recording::to_sample(telemetry);
  const auto is_new = [](const recording::OdometrySample& at) {
    return at.left_counts == 0 && at.right_counts == 0 && at.x_m == 0 && at.y_m == 0 && at.theta_rad == 0;
  };
  if (is_new(now) && !is_new(sample_)) return true;
  const double since_s = in_seconds(session.client().now() - seen_at_);
  const double expected_s = 1e-6 * static_cast<double>(seen_device_us_) + kSlowest * since_s - kLate_s;
  return restarted_ || 1e-6 * static_cast<double>(telemetry.device_time_us) < expected_s;
}

void ContinuousOdometry::restore(RobotSession& session, const protocol::Telemetry& telemetry) {
  constexpr microseconds kBetweenTries = std::chrono::milliseconds(100);
  const microseconds now = session.client().now();
  if (now < next_try_) return;
  next_try_ = now + kBetweenTries;
  const double running_s = 1e-6 * static_cast<double>(telemetry.device_time_us);
  const Symmetric3 unseen = rolled_unseen(std::max(0.0, in_seconds(now - seen_at_) - running_s));
  try {
    put(session, {pose_->x, pose_->y, pose_->theta}, sample_.theta_rad, track_.covariance() + unseen);
  } catch (const robot::RobotRefused&) {
    return;  // it still rolls
  }
  restoring_ = restarted_ = false;
  unanswered_.reset();
  event_ = "the robot has restarted: its odometry continues from the last pose, with a larger covariance";
}

/// A robot without power rolls on from its last speed; a robot at rest may have been pushed by a hand at its switch.
Symmetric3 ContinuousOdometry::rolled_unseen(double until_restart_s) const {
  constexpr double kLongest_s = 2, kRoll_s = 1, kPush_m = 0.01, kPush_rad = 0.02;
  const double moved_s = std::min(until_restart_s, kLongest_s) + kRoll_s;
  const double way_m = std::abs(sample_.v_mps) * moved_s + kPush_m;
  const double turn_rad = std::abs(sample_.omega_radps) * moved_s + kPush_rad;
  return {way_m * way_m, 0, 0, way_m * way_m, 0, turn_rad * turn_rad};
}

}  // namespace astro::live
