#pragma once

#include <cstdint>
#include <functional>

#include "host/recording/run/planar_pose.hpp"
#include "host/recording/run/run.hpp"
#include "host/robot/client/client.hpp"

namespace astro::commands {

/// Receives the robot's odometry for as long as the object lives, and keeps the newest sample.
class OdometryWatch {
 public:
  using Listener = std::function<void(const recording::OdometrySample&)>;

  static constexpr std::uint32_t kFields = protocol::Telemetry::kPose | protocol::Telemetry::kTwist;

  /// `listener` gets every sample; it must not call the client. `fields` must contain kPose.
  OdometryWatch(
      robot::Client& client, std::uint16_t period_ms, Listener listener = [](const auto&) {},
      std::uint32_t fields = kFields);
  ~OdometryWatch();
  OdometryWatch(const OdometryWatch&) = delete;
  OdometryWatch& operator=(const OdometryWatch&) = delete;

  /// Newest sample; all zero before the first.
  const recording::OdometrySample& newest() const { return newest_; }

  /// Waits for a sample that the robot took after this call. Throws LinkLost if none comes.
  const recording::OdometrySample& fresh();

 private:
  robot::Client& client_;
  recording::OdometrySample newest_;
  robot::Subscription subscription_;
};

inline recording::PlanarPose pose_of(const recording::OdometrySample& sample) {
  return {sample.x_m, sample.y_m, sample.theta_rad};
}

}  // namespace astro::commands
