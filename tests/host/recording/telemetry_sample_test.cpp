#include "host/recording/telemetry_sample.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace astro::recording {
namespace {

using protocol::GyroState;

/// The rate that is recorded of a robot whose gyro is in this state and says this.
double recorded_radps(GyroState state, std::int32_t rate_uradps) {
  protocol::Telemetry telemetry;
  telemetry.fields = protocol::Telemetry::kFused;
  telemetry.fused.gyro = state;
  telemetry.fused.time_us = 1;
  telemetry.fused.rate_uradps = rate_uradps;
  NewGyroPoses poses;
  const auto pose = poses.next(telemetry);
  EXPECT_TRUE(pose);
  EXPECT_FALSE(poses.next(telemetry)) << "each once";
  return pose ? pose->omega_radps : 0;
}

TEST(NewGyroPoses, HaveNoRateWhileTheGyroMeasuresNone) {
  for (const GyroState state : {GyroState::running, GyroState::learning})
    EXPECT_DOUBLE_EQ(recorded_radps(state, 500'000), 0.5);
  for (const GyroState state :
       {GyroState::absent, GyroState::starting, GyroState::silent, GyroState::frozen, GyroState::failed})
    EXPECT_TRUE(std::isnan(recorded_radps(state, 0))) << "it would count as a robot that did not turn";
}

TEST(NewGyroPoses, KeepTheKickThatSaturatesAGyro) {
  EXPECT_DOUBLE_EQ(recorded_radps(GyroState::saturated, 8'000'000), 8);
  EXPECT_TRUE(std::isnan(recorded_radps(GyroState::saturated, 0)));
}

// A robot that learns its bias of 0.02 rad/s, and then that it is 0.021, while it turns at 0.5 rad/s all the time.
TEST(RecordedGyroPoses, HaveTheSameBiasWhateverTheRobotLearns) {
  for (const std::int32_t first : {0, 20'000}) {
    RecordedGyroPoses poses;
    std::uint64_t time_us = 0;
    for (const std::int32_t bias : {first, 20'000, 21'000}) {
      protocol::Telemetry telemetry;
      telemetry.fields = protocol::Telemetry::kFused;
      telemetry.fused.gyro = bias == 0 ? GyroState::learning : GyroState::running;
      telemetry.fused.time_us = time_us += 10'000;
      telemetry.fused.rate_uradps = 520'000 - bias;
      telemetry.fused.bias_uradps = bias;
      const auto pose = poses.next(telemetry);
      ASSERT_TRUE(pose);
      EXPECT_DOUBLE_EQ(pose->omega_radps, 1e-6 * (520'000 - first));
    }
  }
}

}  // namespace
}  // namespace astro::recording
