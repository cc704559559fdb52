#include "common/control/wheel_controller.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/fixed/seeded.hpp"

namespace astro {
namespace {

constexpr std::int32_t kNoLimit_uv = 2'000'000'000;
constexpr std::int32_t kLimit_uv = 12'000'000;

std::int32_t q16(double value) { return static_cast<std::int32_t>(std::lround(value * 65536)); }

struct Gains {
  double kp = 0, ki = 0, kS = 0, kV = 0, kA = 0;
};

WheelGains set_of(const Gains& gains) {
  const auto raw = [](double value) { return Q16::from_raw(q16(value)); };
  return {raw(gains.kp), raw(gains.ki), raw(gains.kS), raw(gains.kV), raw(gains.kA)};
}

TEST(WheelController, EachWheelHasAFeedForwardOfItsOwn) {
  ParameterSet set;
  set.set(Param::kS_left, q16(1));
  set.set(Param::kV_right, q16(2));
  set.set(Param::kA_left, q16(3));
  EXPECT_EQ(left_gains(set).kS.raw(), q16(1));
  EXPECT_EQ(right_gains(set).kS.raw(), set.get(Param::kS_right));
  EXPECT_EQ(left_gains(set).kV.raw(), set.get(Param::kV_left));
  EXPECT_EQ(right_gains(set).kV.raw(), q16(2));
  EXPECT_EQ(left_gains(set).kA.raw(), q16(3));
  EXPECT_EQ(right_gains(set).kA.raw(), set.get(Param::kA_right));
}

/// A controller with set point and measured speed as inputs.
class Loop {
 public:
  explicit Loop(const Gains& gains) { set_gains(set_of(gains)); }
  void set_gains(const WheelGains& gains) { wheel_.set_gains(gains); }
  std::int32_t advance(std::int32_t set_point, std::int32_t acceleration, std::int32_t measured,
                       std::int32_t limit) {
    limited = false;
    return wheel_.advance({set_point, acceleration, subtract_saturated(set_point, measured)}, limit, limited);
  }
  void reset() { wheel_.reset(); }

  bool limited = false;

 private:
  WheelController wheel_;
};

Loop controller(const Gains& gains) { return Loop(gains); }

TEST(WheelController, FeedForwardAloneIsTheMotorsModel) {
  Loop wheel = controller({.kS = 0.9, .kV = 12.05, .kA = 1.25});
  // 0.9 V + 12.05 Vs/m * 0.3 m/s + 1.25 Vs^2/m * 0.5 m/s^2. A gain is good to 2^-17: 8 uV per m/s.
  EXPECT_NEAR(wheel.advance(300'000, 500'000, 0, kNoLimit_uv), 5'140'000, 30);
  EXPECT_NEAR(wheel.advance(300'000, 500'000, 299'000, kNoLimit_uv), 5'140'000, 30)
      << "measured speed must not matter";
  EXPECT_NEAR(wheel.advance(-300'000, -500'000, 0, kNoLimit_uv), -5'140'000, 30);
}

TEST(WheelController, StaticFrictionFadesInOverEightMillimetresASecond) {
  Loop wheel = controller({.kS = 0.9});
  EXPECT_EQ(wheel.advance(0, 0, 0, kNoLimit_uv), 0);
  EXPECT_NEAR(wheel.advance(4'096, 0, 0, kNoLimit_uv), 450'000, 10);
  EXPECT_NEAR(wheel.advance(8'192, 0, 0, kNoLimit_uv), 900'000, 10);
  EXPECT_NEAR(wheel.advance(700'000, 0, 0, kNoLimit_uv), 900'000, 10);
  EXPECT_NEAR(wheel.advance(-8'192, 0, 0, kNoLimit_uv), -900'000, 10);
}

TEST(WheelController, ProportionalPartAloneIsTheGainTimesTheError) {
  Loop wheel = controller({.kp = 20});
  EXPECT_EQ(wheel.advance(100'000, 0, 150'000, kNoLimit_uv), -1'000'000);
  EXPECT_EQ(wheel.advance(100'000, 0, 50'000, kNoLimit_uv), 1'000'000) << "no memory";
}

TEST(WheelController, IntegralPartAloneIsTheGainTimesErrorTimesTime) {
  Loop wheel = controller({.ki = 60});
  std::int32_t out = 0;
  for (int tick = 0; tick <= 1000; ++tick) out = wheel.advance(100'000, 0, 50'000, kNoLimit_uv);
  EXPECT_NEAR(out, 3'000'000, 30);  // 60 V/m * 0.05 m; ki per tick is good to 2^-24
}

TEST(WheelController, OutputNeverExceedsTheLimit) {
  tests::Seeded random(1);
  Loop wheel = controller({.kp = 1000, .ki = 10'000, .kS = 50, .kV = 1000, .kA = 100});
  for (int i = 0; i < 100'000; ++i) {
    const std::int32_t limit = random.between32(0, 50'000'000);
    const std::int32_t out = wheel.advance(static_cast<std::int32_t>(random.any_size(31)),
                                           static_cast<std::int32_t>(random.any_size(31)),
                                           static_cast<std::int32_t>(random.any_size(31)), limit);
    ASSERT_LE(std::abs(out), limit);
    if (wheel.limited) {
      ASSERT_EQ(std::abs(out), limit);
    }
  }
}

TEST(WheelController, LeavesTheLimitInTheTickInWhichTheErrorTurns) {
  for (const int sign : {1, -1}) {
    Loop wheel = controller({.kp = 20, .ki = 60});
    // The integral slowly reaches the limit; then ten seconds at the limit.
    for (int tick = 0; tick < 20'000; ++tick) wheel.advance(sign * 500'000, 0, sign * 450'000, kLimit_uv);
    ASSERT_EQ(wheel.advance(sign * 500'000, 0, sign * 450'000, kLimit_uv), sign * kLimit_uv);
    EXPECT_LT(sign * wheel.advance(sign * 500'000, 0, sign * 550'000, kLimit_uv), kLimit_uv);
  }
}

TEST(WheelController, UnreachableSetPointDoesNotWindUp) {
  Loop wound = controller({.kp = 20, .ki = 60, .kV = 12}), fresh = wound;
  for (int tick = 0; tick < 10'000; ++tick)
    ASSERT_EQ(wound.advance(2'000'000, 0, 900'000, kLimit_uv), kLimit_uv);
  // Back to a speed that can be reached: as if the ten seconds had not happened.
  EXPECT_EQ(wound.advance(500'000, 0, 520'000, kLimit_uv), fresh.advance(500'000, 0, 520'000, kLimit_uv));
}

TEST(WheelController, AFallingSupplyShrinksTheIntegralWithIt) {
  Loop wheel = controller({.ki = 60});
  for (int tick = 0; tick < 20'000; ++tick) wheel.advance(500'000, 0, 0, kLimit_uv);
  wheel.advance(0, 0, 1, 6'000'000);  // a hair the other way: the integral is now held to the lower limit
  EXPECT_LE(wheel.advance(0, 0, 0, kLimit_uv), 6'000'000);
}

TEST(WheelController, ForwardAndBackwardAreMirrorImages) {
  tests::Seeded random(2);
  const Gains gains{.kp = 20, .ki = 60, .kS = 0.9, .kV = 12.05, .kA = 1};
  Loop forward = controller(gains), backward = controller(gains);
  for (int i = 0; i < 10'000; ++i) {
    const std::int32_t v = random.between32(-750'000, 750'000), a = random.between32(-500'000, 500'000);
    const std::int32_t measured = v + random.between32(-50'000, 50'000);
    // The sum and the integral round down, a microvolt each, and the fade of kS ends one step of 2 uV earlier
    // on the positive side.
    ASSERT_NEAR(forward.advance(v, a, measured, kLimit_uv), -backward.advance(-v, -a, -measured, kLimit_uv),
                5);
  }
}

TEST(WheelController, ChangingGainsAtZeroErrorDoesNotStep) {
  Loop wheel = controller({.kp = 20, .ki = 60});
  for (int tick = 0; tick < 500; ++tick) wheel.advance(300'000, 0, 250'000, kLimit_uv);
  const std::int32_t before = wheel.advance(300'000, 0, 300'000, kLimit_uv);
  ASSERT_GT(before, 1'000'000);
  wheel.set_gains(set_of({.kp = 200, .ki = 5, .kA = 3}));
  EXPECT_EQ(wheel.advance(300'000, 0, 300'000, kLimit_uv), before);
}

TEST(WheelController, ResetForgetsTheIntegral) {
  Loop wheel = controller({.ki = 60});
  for (int tick = 0; tick < 500; ++tick) wheel.advance(300'000, 0, 0, kLimit_uv);
  wheel.reset();
  EXPECT_EQ(wheel.advance(0, 0, 0, kLimit_uv), 0);
}

}  // namespace
}  // namespace astro
