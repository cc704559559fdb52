#include "common/control/twist_ramp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/common/fixed/seeded.hpp"

namespace astro {
namespace {

constexpr MotionLimits kLimits{.speed_umps = 750'000,
                               .yaw_rate_uradps = 2'000'000,
                               .acceleration_umps2 = 500'000,
                               .yaw_acceleration_uradps2 = 3'000'000,
                               .jerk_mmps3 = 20'000,
                               .yaw_jerk_mradps3 = 120'000};

TwistRamp ramp_with(const MotionLimits& limits) {
  TwistRamp ramp;
  ramp.set_rates(TwistRamp::Rates(limits));
  return ramp;
}

TEST(TwistRamp, SitsExactlyOnItsTargetAndStaysThere) {
  TwistRamp ramp = ramp_with(kLimits);
  ramp.set_target({100'000, 0});
  for (int i = 0; i < 400; ++i) ramp.advance();
  for (int i = 0; i < 1000; ++i) {
    ramp.advance();
    ASSERT_EQ(ramp.value(), (BodyTwist{100'000, 0})) << "a command of 0.100 m/s is 0.100 m/s, not a dither";
    ASSERT_EQ(ramp.acceleration(), (BodyTwist{0, 0}));
  }
  EXPECT_TRUE(ramp.arrived());
}

TEST(TwistRamp, TakesTheTimeOfAnSCurve) {
  // v / a + a / j = 0.3 / 0.5 + 0.5 / 20 = 0.625 s.
  TwistRamp ramp = ramp_with(kLimits);
  ramp.set_target({300'000, 0});
  int ticks = 0;
  while (!ramp.arrived() && ticks < 2000) ramp.advance(), ++ticks;
  EXPECT_NEAR(ticks, 625, 2);  // the steps of one tick at both ends
}

TEST(TwistRamp, WithoutAJerkLimitItIsARampOfConstantAcceleration) {
  MotionLimits limits = kLimits;
  limits.jerk_mmps3 = limits.yaw_jerk_mradps3 = 0;
  TwistRamp ramp = ramp_with(limits);
  ramp.set_target({300'000, 0});
  for (int tick = 1; tick < 600; ++tick) {
    ramp.advance();
    ASSERT_EQ(ramp.value().v_umps, 500 * tick);
    ASSERT_EQ(ramp.acceleration().v_umps, 500'000);
  }
}

TEST(TwistRamp, SpeedAndYawRateKeepTheirRatioFromRestToTheTarget) {
  for (const BodyTwist target : {BodyTwist{600'000, 2'000'000}, {100'000, -2'000'000}, {-700'000, 50'000}}) {
    TwistRamp ramp = ramp_with(kLimits);
    ramp.set_target(target);
    const double ratio = static_cast<double>(target.omega_uradps) / target.v_umps;
    while (!ramp.arrived()) {
      ramp.advance();
      // Both are cut to whole 1e-6, and a rate per tick is good to 2^-12 of that, over at most 1200 ticks.
      ASSERT_NEAR(ramp.value().omega_uradps, ratio * ramp.value().v_umps, 2 + 1.5 * std::abs(ratio));
    }
  }
}

/// For any targets at any time, the ramp is never steeper than the limits, and arrives.
TEST(TwistRamp, NeverExceedsItsLimitsWhateverIsAskedOfIt) {
  tests::Seeded random(1);
  for (int trial = 0; trial < 300; ++trial) {
    MotionLimits limits = kLimits;
    limits.acceleration_umps2 = random.between32(10'000, 20'000'000);
    limits.yaw_acceleration_uradps2 = random.between32(10'000, 200'000'000);
    limits.jerk_mmps3 = random.between32(100, 1'000'000);
    limits.yaw_jerk_mradps3 = random.between32(100, 10'000'000);
    TwistRamp ramp = ramp_with(limits);
    BodyTwist last, last_rate;
    for (int command = 0; command < 20; ++command) {
      ramp.set_target({random.between32(-750'000, 750'000), random.between32(-2'000'000, 2'000'000)});
      for (int tick = random.between32(1, 300); tick > 0; --tick) {
        ramp.advance();
        const BodyTwist now = ramp.value();
        const BodyTwist rate{now.v_umps - last.v_umps, now.omega_uradps - last.omega_uradps};
        // One unit for the cut of each value, and one jerk for the step onto the target.
        // However small the jerk limit is, the acceleration rises within half a second.
        const double v_jerk = std::max(limits.jerk_mmps3 * 1e-3, limits.acceleration_umps2 * 1e-3 / 500 + 1);
        const double omega_jerk =
            std::max(limits.yaw_jerk_mradps3 * 1e-3, limits.yaw_acceleration_uradps2 * 1e-3 / 500 + 1);
        ASSERT_LE(std::abs(now.v_umps), 750'000 + 1) << "beyond all that was asked for, trial " << trial;
        ASSERT_LE(std::abs(now.omega_uradps), 2'000'000 + 1) << trial;
        ASSERT_LE(std::abs(rate.v_umps), limits.acceleration_umps2 * 1e-3 + 1) << trial;
        ASSERT_LE(std::abs(rate.omega_uradps), limits.yaw_acceleration_uradps2 * 1e-3 + 1) << trial;
        ASSERT_LE(std::abs(rate.v_umps - last_rate.v_umps), 2 * v_jerk + 2) << trial;
        ASSERT_LE(std::abs(rate.omega_uradps - last_rate.omega_uradps), 2 * omega_jerk + 2) << trial;
        last = now;
        last_rate = rate;
      }
    }
  }
}

TEST(TwistRamp, ArrivesFromWhereverItIsWithoutPassingASteadyTarget) {
  tests::Seeded random(2);
  for (int trial = 0; trial < 300; ++trial) {
    TwistRamp ramp = ramp_with(kLimits);
    const BodyTwist start{random.between32(-750'000, 750'000), random.between32(-2'000'000, 2'000'000)};
    const BodyTwist target{random.between32(-750'000, 750'000), random.between32(-2'000'000, 2'000'000)};
    ramp.set(start);
    ramp.set_target(target);
    int ticks = 0;
    for (; !ramp.arrived() && ticks < 5000; ++ticks) {
      ramp.advance();
      ASSERT_LE(ramp.value().v_umps, std::max(start.v_umps, target.v_umps));
      ASSERT_GE(ramp.value().v_umps, std::min(start.v_umps, target.v_umps));
      ASSERT_LE(ramp.value().omega_uradps, std::max(start.omega_uradps, target.omega_uradps));
      ASSERT_GE(ramp.value().omega_uradps, std::min(start.omega_uradps, target.omega_uradps));
    }
    ASSERT_EQ(ramp.value(), target);
    ASSERT_LT(ticks, 3100) << "1.5 m/s at 0.5 m/s^2 and the ends of the S";
  }
}

TEST(TwistRamp, ANewTargetInTheMiddleOfARampIsReachedAndNotPassedByFar) {
  TwistRamp ramp = ramp_with(kLimits);
  ramp.set_target({500'000, 0});
  for (int tick = 0; tick < 640; ++tick) ramp.advance();
  const std::int32_t v = ramp.value().v_umps + 1'000;
  ramp.set_target({v, 2'000'000});  // hardly any way for one, much for the other
  std::int32_t most = 0;
  int ticks = 0;
  for (; !ramp.arrived() && ticks < 3000; ++ticks) {
    ramp.advance();
    most = std::max(most, ramp.value().v_umps);
  }
  EXPECT_LT(ticks, 1000);
  EXPECT_LE(most, v + 7'000);  // a^2 / 2 j is what the rate takes to come down: 6.25 mm/s
}

TEST(TwistRamp, TheLeastJerkLimitStillStopsWithinASecondMore) {
  MotionLimits limits = kLimits;
  limits.jerk_mmps3 = limits.yaw_jerk_mradps3 = 1;
  TwistRamp ramp = ramp_with(limits);
  ramp.set_target({700'000, 0});
  for (int tick = 0; tick < 600; ++tick) ramp.advance();
  ramp.set(ramp.value());
  ramp.set_target({});
  int ticks = 0;
  for (; !ramp.arrived() && ticks < 5000; ++ticks) ramp.advance();
  EXPECT_LT(ticks, 700 / 0.5 + 1000);
}

TEST(TwistRamp, TheSteepestLimitsDoNotOverflow) {
  TwistRamp ramp = ramp_with({10'000'000, 50'000'000, 50'000'000, 500'000'000, 0, 0});
  for (const int sign : {1, -1, 1}) {
    ramp.set_target({sign * 10'000'000, sign * -50'000'000});
    for (int i = 0; i < 500; ++i) ramp.advance();
    ASSERT_EQ(ramp.value(), (BodyTwist{sign * 10'000'000, sign * -50'000'000}));
  }
}

}  // namespace
}  // namespace astro
