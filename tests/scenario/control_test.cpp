#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/robots/drive_rig.hpp"

// The quality of control: data-sheet motors, one of them 10 % stronger, friction, the slip of the thesis, and
// default parameters unless a test changes them.
namespace astro {
namespace {

using std::numbers::pi;
using support::DriveRig;

void set(ParameterSet& parameters, Param id, double value) {
  const ParamRow& row = param_row(id);
  const double steps =
      row.kind == ParamKind::binary_scaled ? std::pow(2.0, -row.exponent) : std::pow(10.0, -row.exponent);
  parameters.set(id, static_cast<std::int32_t>(std::lround(value * steps)));
}

/// Limits so large that motors and battery decide how fast the robot accelerates.
ParameterSet brisk() {
  ParameterSet parameters;
  set(parameters, Param::acceleration_limit, 4);
  set(parameters, Param::yaw_acceleration_limit, 27);
  set(parameters, Param::jerk_limit, 200);
  set(parameters, Param::yaw_jerk_limit, 1400);
  return parameters;
}

struct Steady {
  double mean = 0, ripple = 0;  // ripple: half of peak to peak, over the mean
};

template <class Value>
Steady watch(DriveRig& rig, int ms, Value value) {
  double sum = 0, least = 1e9, most = -1e9;
  for (int i = 0; i < ms; ++i) {
    rig.step();
    const double now = value();
    sum += now;
    least = std::min(least, now);
    most = std::max(most, now);
  }
  return {sum / ms, (most - least) / 2 / (std::abs(sum) / ms)};
}

TEST(Control, AStepTo300MillimetresPerSecondIsThereIn120MillisecondsWithoutOvershoot) {
  DriveRig rig(support::mismatched_robot(), brisk());
  constexpr double kTarget = 0.3;
  rig.hold_velocity(kTarget, 0);
  int at_10 = 0, at_90 = 0;
  double most = 0;
  for (int ms = 1; ms <= 1000; ++ms) {
    rig.step();
    if (at_10 == 0 && rig.v_mps() > 0.1 * kTarget) at_10 = ms;
    if (at_90 == 0 && rig.v_mps() > 0.9 * kTarget) at_90 = ms;
    most = std::max(most, rig.v_mps());
  }
  const Steady steady = watch(rig, 1000, [&] { return rig.v_mps(); });
  fmt::print(
      "step 0 -> 0.3 m/s: rise {} ms, from the command to 90 % {} ms, overshoot {:.2f} %, steady error "
      "{:.3f} %\n",
      at_90 - at_10, at_90, 100 * (most / kTarget - 1), 100 * (steady.mean / kTarget - 1));
  EXPECT_LE(at_90 - at_10, 120);
  EXPECT_LE(at_90, 120);
  EXPECT_LE(most, 1.05 * kTarget);
  EXPECT_NEAR(steady.mean, kTarget, 0.005 * kTarget);
}

TEST(Control, CreepsAt20MillimetresPerSecondWithLittleRipple) {
  DriveRig rig;
  rig.hold_velocity(0.02, 0);
  rig.run_ms(1000);
  const Steady left = watch(rig, 2000, [&] { return rig.left_mps(); });
  const Steady both = watch(rig, 2000, [&] { return rig.v_mps(); });
  fmt::print("0.02 m/s: ripple {:.1f} % of a wheel, {:.1f} % of the robot, mean off by {:.2f} %\n",
             100 * left.ripple, 100 * both.ripple, 100 * (both.mean / 0.02 - 1));
  EXPECT_LE(left.ripple, 0.10);
  EXPECT_LE(both.ripple, 0.10);
  EXPECT_NEAR(both.mean, 0.02, 0.005 * 0.02);
}

TEST(Control, FullSpeedAndFullYawRateAreReachedTogetherOnOneCurve) {
  for (const double omega : {2.0, -2.0}) {
    DriveRig rig;
    rig.hold_velocity(0.6, omega);
    double worst = 0;
    for (int ms = 0; ms < 2500; ++ms) {
      rig.step();
      if (rig.v_mps() < 0.1) continue;  // a few millimetres, in which friction decides which wheel starts
      worst = std::max(worst, std::abs(rig.omega_radps() / rig.v_mps() / (omega / 0.6) - 1));
    }
    const Steady v = watch(rig, 500, [&] { return rig.v_mps(); });
    const Steady turn = watch(rig, 500, [&] { return rig.omega_radps(); });
    const double curvature = turn.mean / v.mean / (omega / 0.6) - 1;
    fmt::print(
        "0.6 m/s and {:+.0f} rad/s: {:.4f} m/s, {:+.4f} rad/s, curvature off by {:.3f} %, on the way by "
        "{:.2f} %\n",
        omega, v.mean, turn.mean, 100 * curvature, 100 * worst);
    EXPECT_NEAR(v.mean, 0.6, 0.003);
    EXPECT_NEAR(turn.mean, omega, 0.01);
    EXPECT_NEAR(curvature, 0, 0.001);
    EXPECT_LE(worst, 0.02);
  }
}

TEST(Control, WithALowBatteryTheRobotIsSlowerOnTheSameCurve) {
  sim::Config config = support::mismatched_robot();
  config.supply_V = 11;
  DriveRig rig(config);
  rig.hold_velocity(0.6, 2);  // the outer wheel has the motor that needs more voltage
  rig.run_ms(4000);
  const Steady v = watch(rig, 500, [&] { return rig.v_mps(); });
  const Steady turn = watch(rig, 500, [&] { return rig.omega_radps(); });
  const double curvature = turn.mean / v.mean / (2 / 0.6) - 1;
  fmt::print("0.6 m/s and 2 rad/s at 11 V: {:.4f} m/s, curvature off by {:.2f} %\n", v.mean, 100 * curvature);
  EXPECT_LT(v.mean, 0.59) << "the supply was to be too low";
  EXPECT_NEAR(curvature, 0, 0.01);
}

class ThreeMetreSquare : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(BothWays, ThreeMetreSquare, testing::Values(1, -1),
                         [](const auto& sense) { return sense.param > 0 ? "Ccw" : "Cw"; });

TEST_P(ThreeMetreSquare, ClosesInItsOwnOdometry) {
  constexpr double kSide_m = 3;
  const int sense = GetParam();
  DriveRig rig;
  for (int corner = 0; corner < 4; ++corner) {
    ASSERT_TRUE(rig.add({.length_nm = 3'000'000'000, .speed_umps = 300'000}, 2 * corner + 1));
    ASSERT_TRUE(rig.add({.angle_32 = sense * (std::int64_t{1} << 30)}, 2 * corner + 2));
  }
  const std::array<std::array<double, 2>, 4> corners{
      {{0, 0}, {kSide_m, 0}, {kSide_m, sense * kSide_m}, {0, sense * kSide_m}}};
  double cross_m = 0;
  rig.run_ms(11);  // planned, and begun in one tick of ten
  while (rig.drive().running_tag() != 0) {
    rig.step();
    const int tag = rig.drive().running_tag();
    if (tag % 2 == 0) continue;
    const int side = tag / 2;
    const double along_rad = sense * side * pi / 2;
    const support::OdometryPose at = rig.odometry();
    cross_m = std::max(cross_m, std::abs(-std::sin(along_rad) * (at.x_m - corners[side][0]) +
                                         std::cos(along_rad) * (at.y_m - corners[side][1])));
  }
  const support::OdometryPose end = rig.odometry();
  const double closure_m = std::hypot(end.x_m, end.y_m), turn_rad = end.theta_rad - sense * 2 * pi;
  fmt::print("3 m square: closure {:.3f} mm and {:.3f} mrad, cross-track at most {:.3f} mm\n",
             1e3 * closure_m, 1e3 * turn_rad, 1e3 * cross_m);
  EXPECT_EQ(rig.drive().faults().mask(), 0U);
  EXPECT_LE(closure_m, 0.003);
  EXPECT_LE(std::abs(turn_rad), 0.003);
  EXPECT_LE(cross_m, 0.005);
}

TEST(Control, ALineOfTenMetresIsStraightInItsOwnOdometry) {
  DriveRig rig;
  ASSERT_TRUE(rig.add({.length_nm = 10'000'000'000, .speed_umps = 500'000}));
  rig.run_ms(11);  // planned, and begun in one tick of ten
  double cross_m = 0;
  while (rig.drive().running_tag() != 0) {
    rig.step();
    cross_m = std::max(cross_m, std::abs(rig.odometry().y_m));
  }
  fmt::print("10 m line: cross-track at most {:.3f} mm, length off by {:.3f} mm\n", 1e3 * cross_m,
             1e3 * (rig.odometry().x_m - 10));
  EXPECT_LE(cross_m, 0.002);
  EXPECT_NEAR(rig.odometry().x_m, 10, 0.002);
}

/// Half the stall torque of 1.76 N m, all at once, for three seconds and gone again.
void load_left_wheel(DriveRig& rig, const char* what) {
  const auto heading = [&] { return rig.board().truth().theta_rad; };
  rig.run_ms(3000);
  const double before = heading();
  for (const double torque_Nm : {-0.88, 0.0}) {
    rig.board().set_load(Side::left, {.torque_Nm = torque_Nm});
    double worst = 0;
    for (int ms = 0; ms < 3000; ++ms) {
      rig.step();
      worst = std::max(worst, std::abs(heading() - before));
    }
    const double left = std::abs(heading() - before);
    fmt::print("{}, load {} N m: heading disturbed by {:.2f} degrees, {:.3f} left after 3 s\n", what,
               torque_Nm, worst * 180 / pi, left * 180 / pi);
    EXPECT_LE(worst, pi / 180);
    EXPECT_LE(left, 0.1 * pi / 180);
  }
  EXPECT_EQ(rig.drive().faults().mask(), 0U);
}

sim::Config without_slip() {
  sim::Config config = support::mismatched_robot();
  config.slip_m = 0;  // slip turns the robot, and no control can measure that
  return config;
}

TEST(Control, HalfTheStallTorqueOnOneWheelDisturbsTheHeadingByLessThanADegree) {
  DriveRig on_line(without_slip());
  ASSERT_TRUE(on_line.add({.length_nm = 4'000'000'000, .speed_umps = 300'000}));
  load_left_wheel(on_line, "on a line at 0.3 m/s");
  DriveRig at_velocity(without_slip());
  at_velocity.hold_velocity(0.3, 0);
  load_left_wheel(at_velocity, "at a velocity of 0.3 m/s");
}

TEST(Control, APureSpinDrawsNoCircle) {
  for (const double b_m : {0.29, 0.31}) {  // a calibrated wheelbase too
    ParameterSet parameters;
    set(parameters, Param::b, b_m);
    DriveRig rig(without_slip(), parameters);
    rig.hold_velocity(0, 1);
    double away_m = 0;
    for (int ms = 0; ms < 10'000; ++ms) {
      rig.step();
      away_m = std::max(away_m, std::hypot(rig.odometry().x_m, rig.odometry().y_m));
    }
    fmt::print("spin at 1 rad/s, b = {} m: {:.2f} rad, centre moved by at most {:.3f} mm\n", b_m,
               rig.odometry().theta_rad, 1e3 * away_m);
    EXPECT_GT(rig.odometry().theta_rad, 9);
    EXPECT_LE(away_m, 0.0005);  // six counts: friction lets one wheel start first
  }
}

TEST(Control, ACommandOf100MillimetresPerSecondIsThatAndNoDither) {
  DriveRig rig;
  rig.hold_velocity(0.1, 0);
  rig.run_ms(1000);
  for (int ms = 0; ms < 1000; ++ms) {
    rig.step();
    ASSERT_EQ(rig.drive().wheels().set_points(), (WheelSpeeds{100'000, 100'000}));
  }
  const Steady v = watch(rig, 1000, [&] { return rig.v_mps(); });
  fmt::print("0.100 m/s: {:.6f} m/s, ripple {:.2f} %\n", v.mean, 100 * v.ripple);
  EXPECT_NEAR(v.mean, 0.1, 0.0001);
  EXPECT_LE(v.ripple, 0.02);
}

}  // namespace
}  // namespace astro
