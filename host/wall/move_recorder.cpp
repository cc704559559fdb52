#include "host/wall/move_recorder.hpp"

#include <cmath>

#include "host/base/utc.hpp"

namespace astro::wall {

using protocol::Telemetry;

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
  if (!pose || !std::isfinite(pose->omega_radps)) return;
  if (telemetry.fused.gyro == protocol::GyroState::learning) return;  // its bias is not known
  if (!first_bias_uradps_) first_bias_uradps_ = telemetry.fused.bias_uradps;
  pose->omega_radps += 1e-6 * (telemetry.fused.bias_uradps - *first_bias_uradps_);
  run_.gyro.push_back(*pose);
}

}  // namespace astro::wall
