#include "common/control/wheel_pair.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace astro {
namespace {

constexpr std::int32_t kSupply_uv = 12'000'000;

/// Both wheels as the feed-forward models them: V = kV v + kA dv/dt + load, in 1 ms steps.
class Wheels {
 public:
  double left_load_V = 0;
  double left_mps = 0, right_mps = 0, left_m = 0, right_m = 0;

  void advance(const WheelVoltages& voltages) {
    step(left_mps, left_m, voltages.left_uv * 1e-6 - left_load_V);
    step(right_mps, right_m, voltages.right_uv * 1e-6);
  }
  WheelSpeeds speeds() const { return {micro(left_mps), micro(right_mps)}; }

 private:
  static constexpr double kV = 12.2, kA = 1.1, kTick_s = 1e-3;
  static std::int32_t micro(double value) { return static_cast<std::int32_t>(std::lround(value * 1e6)); }
  static void step(double& v_mps, double& x_m, double volts) {
    v_mps += (volts - kV * v_mps) / kA * kTick_s;
    x_m += v_mps * kTick_s;
  }
};

ParameterSet without_friction() {
  ParameterSet set;
  set.set(Param::kS_left, 0);
  set.set(Param::kS_right, 0);
  return set;
}

class Pair : public testing::Test {
 protected:
  void run(const WheelSpeeds& set_points, int ticks) {
    for (int i = 0; i < ticks; ++i) wheels.advance(pair.advance(set_points, {}, wheels.speeds(), kSupply_uv));
  }
  void use(const ParameterSet& set) { pair.set_gains(set); }

  WheelPair pair;
  Wheels wheels;
};

TEST_F(Pair, AWheelThatWasHeldUpCatchesUpUntilBothHaveGoneAsFarAsWanted) {
  use(without_friction());
  run({300'000, 300'000}, 1000);
  const double ahead_m = wheels.right_m - wheels.left_m;
  wheels.left_load_V = 6;  // half the stall torque
  run({300'000, 300'000}, 60);
  EXPECT_GT(wheels.right_m - wheels.left_m - ahead_m, 0.001) << "no disturbance was made";
  run({300'000, 300'000}, 2000);
  EXPECT_NEAR(wheels.right_m - wheels.left_m - ahead_m, 0, 1e-5);  // speeds are known to 1e-6 m/s
}

TEST_F(Pair, WithoutCouplingTheDifferenceStays) {
  ParameterSet set = without_friction();
  set.set(Param::k_sync, 0);
  use(set);
  run({300'000, 300'000}, 1000);
  wheels.left_load_V = 6;
  run({300'000, 300'000}, 3000);
  // ki integral(e) dt holds the load: 6 V / 1200 V/m.
  EXPECT_NEAR(wheels.right_m - wheels.left_m, 0.005, 1e-4);
}

TEST_F(Pair, TheFreeWheelWaitsForABlockedOneAndDoesNotTurnBack) {
  use(without_friction());
  run({300'000, 300'000}, 500);
  for (int i = 0; i < 2000; ++i) {
    wheels.left_mps = 0;  // a wall
    run({300'000, 300'000}, 1);
    ASSERT_GT(wheels.right_mps, -0.06) << i;  // a fifth of the set point: how far the loop overshoots
  }
  EXPECT_LT(wheels.right_mps, 0.05);
}

TEST_F(Pair, ForWantOfVoltageBothWheelsSlowDownOnTheSameCurve) {
  use(without_friction());
  run({700'000, 1'200'000}, 4000);  // 1.2 m/s would take 14.6 V
  EXPECT_NEAR(wheels.right_mps, 12.0 / 12.2, 0.01);
  EXPECT_NEAR(wheels.left_mps / wheels.right_mps, 7.0 / 12.0, 0.005);
  EXPECT_LT(pair.share(), 1 << 16);
  run({350'000, 600'000}, 2000);
  EXPECT_EQ(pair.share(), 1 << 16) << "what can be reached again is reached in full";
  EXPECT_NEAR(wheels.right_mps, 0.6, 1e-4);
  EXPECT_NEAR(wheels.left_mps, 0.35, 1e-4);
}

TEST_F(Pair, NewGainsUnderWayDoNotBumpTheWheels) {
  use(without_friction());
  wheels.left_load_V = 3;
  for (int i = 0; i < 30; ++i)
    wheels.advance(pair.advance({200'000, 300'000}, {400'000, 600'000}, wheels.speeds(), kSupply_uv));
  const WheelSpeeds set_points{200'000, 300'000}, accelerations{400'000, 600'000}, measured = wheels.speeds();
  WheelPair changed = pair;
  ParameterSet other;
  other.set(Param::kp, 20 << 16);
  other.set(Param::ki, 300 << 16);
  other.set(Param::kV_left, 10 << 16);
  other.set(Param::kA_right, 2 << 16);
  other.set(Param::k_sync, 1 << 16);
  // The last advance has changed both integrals; the gains change at the present ones.
  WheelPair unchanged = pair;
  changed.set_gains(other, set_points, accelerations, measured);
  const WheelVoltages before = unchanged.advance(set_points, accelerations, measured, kSupply_uv);
  const WheelVoltages after = changed.advance(set_points, accelerations, measured, kSupply_uv);
  EXPECT_NEAR(after.left_uv, before.left_uv, 2);  // one step of the sum, and one of the integral
  EXPECT_NEAR(after.right_uv, before.right_uv, 2);
}

TEST_F(Pair, ResetForgetsWhatWasBehindAndWhatWasMissing) {
  use(without_friction());
  wheels.left_load_V = 20;
  run({900'000, 900'000}, 1000);
  pair.reset();
  WheelPair fresh;
  fresh.set_gains(without_friction());
  const WheelVoltages a = pair.advance({100'000, 100'000}, {}, {}, kSupply_uv);
  const WheelVoltages b = fresh.advance({100'000, 100'000}, {}, {}, kSupply_uv);
  EXPECT_EQ(a.left_uv, b.left_uv);
  EXPECT_EQ(a.right_uv, b.right_uv);
}

}  // namespace
}  // namespace astro
