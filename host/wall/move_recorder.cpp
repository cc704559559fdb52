#include "host/wall/move_recorder.hpp"

#include "host/base/utc.hpp"

namespace astro::wall {

using protocol::Telemetry;

namespace {

/// A saturated gyro that turns further than the wheels shows a kick. If it turns less far than they do, its rate is zero.
bool measures(const protocol::FusedGroup& fused) {
  using State = protocol::GyroState;
  return fused.gyro == State::running || (fused.gyro == State::saturated && fused.rate_uradps != 0);
}

}  // namespace

MoveRecorder::MoveRecorder(robot::Client& client, recording::RunInfo info)
    : info_(std::move(info)),
      subscription_(client.on<Telemetry>([this](const Telemetry& telemetry) { add(telemetry); })) {
  take();
}

recording::Run MoveRecorder::take() {
  recording::Run begun;
  begun.info = info_;
  begun.info.started_at = utc_now();
  return std::exchange(run_, std::move(begun));
}

void MoveRecorder::add(const Telemetry& telemetry) {
  constexpr std::uint32_t kFields = Telemetry::kPose | Telemetry::kCounts | Telemetry::kTwist;
  if ((telemetry.fields & kFields) != kFields) return;
  run_.odometry.push_back(recording::to_sample(telemetry));
  auto pose = gyro_poses_.next(telemetry);
  if (!pose || !measures(telemetry.fused)) return;
  if (!first_bias_uradps_) first_bias_uradps_ = telemetry.fused.bias_uradps;
  pose->omega_radps += 1e-6 * (telemetry.fused.bias_uradps - *first_bias_uradps_);
  run_.gyro.push_back(*pose);
}

}  // namespace astro::wall
