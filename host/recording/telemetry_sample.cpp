#include "host/recording/telemetry_sample.hpp"

#include <limits>
#include <numbers>

namespace astro::recording {

namespace {

/// `from`: a group with a pose in the robot's own units.
void put_pose(auto& sample, const auto& from) {
  constexpr double kMetre = 0x1p-40;
  constexpr double kTurn = 0x1p-64;
  sample.x_m = static_cast<double>(from.x) * kMetre;
  sample.y_m = static_cast<double>(from.y) * kMetre;
  sample.theta_rad = 2 * std::numbers::pi * (from.turns + static_cast<double>(from.theta) * kTurn);
}

/// A saturated gyro that turns further than the wheels shows a kick. If it turns less far than they do, its rate is zero.
bool measures(const protocol::FusedGroup& fused) {
  using State = protocol::GyroState;
  return fused.gyro == State::running || fused.gyro == State::learning ||
         (fused.gyro == State::saturated && fused.rate_uradps != 0);
}

}  // namespace

OdometrySample to_sample(const protocol::Telemetry& telemetry) {
  OdometrySample sample;
  sample.time_us = static_cast<std::int64_t>(telemetry.device_time_us);
  put_pose(sample, telemetry.pose);
  sample.v_mps = telemetry.twist.v_umps * 1e-6;
  sample.omega_radps = telemetry.twist.omega_uradps * 1e-6;
  sample.left_counts = telemetry.counts.left;
  sample.right_counts = telemetry.counts.right;
  return sample;
}

std::optional<GyroPose> gyro_pose(const protocol::Telemetry& telemetry) {
  if ((telemetry.fields & protocol::Telemetry::kFused) == 0 ||
      telemetry.fused.gyro == protocol::GyroState::off)
    return std::nullopt;
  GyroPose pose;
  pose.time_us = static_cast<std::int64_t>(telemetry.fused.time_us);
  put_pose(pose, telemetry.fused);
  pose.omega_radps = telemetry.fused.rate_uradps * 1e-6;
  return pose;
}

std::optional<GyroPose> NewGyroPoses::next(const protocol::Telemetry& telemetry) {
  std::optional<GyroPose> pose = gyro_pose(telemetry);
  if (!pose || pose->time_us == last_us_) return std::nullopt;
  last_us_ = pose->time_us;
  if (!measures(telemetry.fused)) pose->omega_radps = std::numeric_limits<double>::quiet_NaN();
  return pose;
}

std::optional<GyroPose> RecordedGyroPoses::next(const protocol::Telemetry& telemetry) {
  std::optional<GyroPose> pose = new_poses_.next(telemetry);
  if (!pose) return std::nullopt;
  if (!bias_uradps_) bias_uradps_ = telemetry.fused.bias_uradps;
  pose->omega_radps += 1e-6 * (telemetry.fused.bias_uradps - *bias_uradps_);
  return pose;
}

GyroSlip to_sample(const protocol::SlipFound& found) {
  constexpr double kUnit_rad = 1e-4;
  return {static_cast<std::int64_t>(found.device_time_us), kUnit_rad * found.turn_100urad};
}

}  // namespace astro::recording
