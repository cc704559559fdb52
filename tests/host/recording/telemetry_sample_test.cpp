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

}  // namespace
}  // namespace astro::recording
