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
  if (const auto pose = gyro_poses_.next(telemetry); pose && std::isfinite(pose->omega_radps))
    run_.gyro.push_back(*pose);
}

}  // namespace astro::wall
