#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/robots/drive_rig.hpp"

// Every ramp to rest ends, whatever the robot is wired like, carries, or stands on, and whether or not a host
// is there: either the wheels come to rest, or the bridges open with a fault that says why.
namespace astro {
namespace {

using protocol::Mode;
using support::DriveRig;

/// Parameters of a robot that somebody has entered in a hurry.
ParameterSet with(std::initializer_list<std::pair<Param, std::int32_t>> changes) {
  ParameterSet set = ParameterSet::defaults();
  for (const auto& [param, raw] : changes) set.set(param, raw);
  return set;
}

constexpr std::int32_t q16(double value) { return static_cast<std::int32_t>(value * 65536); }

/// How long the bridges give power after `from`; -1 if they still do after 10 s.
int powered_for_ms(DriveRig& rig) {
  for (int ms = 0; ms < 10'000; ++ms) {
    if (!rig.powered()) return ms;
    rig.step();
  }
  return -1;
}

/// Drives for a while at 0.3 m/s, says Stop, and falls silent.
void drive_and_stop(DriveRig& rig, int drive_ms) {
  rig.hold_velocity(0.3, 0);
  rig.run_ms(drive_ms);
  rig.release();
  rig.drive().stop();
}

struct Robot {
  const char* name;
  ParameterSet set;
  double slope_Nm = 0;  // on each wheel
};
void PrintTo(const Robot& robot, std::ostream* out) { *out << robot.name; }

std::vector<Robot> robots_that_do_not_obey() {
  const std::int32_t reversed = -1;
  return {
      {"both_motors_reversed",
       with({{Param::motor_polarity_left, reversed}, {Param::motor_polarity_right, reversed}})},
      {"both_motors_reversed_on_half_the_voltage", with({{Param::motor_polarity_left, reversed},
                                                         {Param::motor_polarity_right, reversed},
                                                         {Param::motor_voltage_max, 5'000}})},
      {"both_motors_reversed_with_weak_gains", with({{Param::motor_polarity_left, reversed},
                                                     {Param::motor_polarity_right, reversed},
                                                     {Param::kp, q16(13)},
                                                     {Param::ki, 0}})},
      {"both_encoders_reversed",
       with({{Param::encoder_polarity_left, reversed}, {Param::encoder_polarity_right, reversed}})},
      {"gear_ratio_entered_twice",
       with({{Param::gear_numerator, 438 * 438}, {Param::gear_denominator, 100}})},
      {"both_motors_reversed_and_gear_ratio_entered_twice", with({{Param::motor_polarity_left, reversed},
                                                                  {Param::motor_polarity_right, reversed},
                                                                  {Param::gear_numerator, 438 * 438},
                                                                  {Param::gear_denominator, 100}})},
      {"weak_gains_on_a_slope", with({{Param::kp, q16(5)}, {Param::ki, 0}}), 0.25},
  };
}

class NotObeying : public testing::TestWithParam<Robot> {};
INSTANTIATE_TEST_SUITE_P(Robots, NotObeying, testing::ValuesIn(robots_that_do_not_obey()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_P(NotObeying, StopEndsWithoutPowerWithinThreeSecondsOfSilence) {
  for (const int drive_ms : {1, 20, 100, 1500}) {
    SCOPED_TRACE(fmt::format("Stop {} ms after the start", drive_ms));
    DriveRig rig(support::mismatched_robot(), GetParam().set);
    const sim::WheelLoad slope{.torque_Nm = GetParam().slope_Nm};
    for (const Side side : {Side::left, Side::right}) rig.board().set_load(side, slope);
    drive_and_stop(rig, drive_ms);
    rig.silent = true;
    const int ms = powered_for_ms(rig);
    fmt::print("{}: without power {} ms after Stop, faults {:#x}\n", GetParam().name, ms,
               rig.drive().faults().mask());
    EXPECT_GE(ms, 0) << "still powered after 10 s";
    EXPECT_LE(ms, 3000);
    rig.run_ms(3000);
    EXPECT_FALSE(rig.powered());
  }
}

TEST_P(NotObeying, StopEndsWithoutPowerAlsoWithAHostThatStays) {
  DriveRig rig(support::mismatched_robot(), GetParam().set);
  const sim::WheelLoad slope{.torque_Nm = GetParam().slope_Nm};
  for (const Side side : {Side::left, Side::right}) rig.board().set_load(side, slope);
  drive_and_stop(rig, 20);
  const int ms = powered_for_ms(rig);
  EXPECT_GE(ms, 0) << "still powered after 10 s";
  EXPECT_LE(ms, 3000);
}

// Whoever says Stop is there, so the silence that is allowed in a ramp begins with it. Otherwise the bridges would open at full
// speed, and the robot would roll on.
TEST(Stopping, OfARobotWhoseDriverHasLongFallenSilentRampsToRest) {
  for (const std::int32_t timeout_ms : {0, 60'000}) {
    DriveRig rig(support::mismatched_robot(), with({{Param::command_timeout, timeout_ms}}));
    rig.hold_velocity(0.6, 0);
    rig.run_ms(2000);
    rig.release();
    rig.silent = true;
    rig.run_ms(5000);
    ASSERT_GT(rig.drive().twist().v_umps, 500'000) << "it drives on";
    rig.drive().stop();
    while (rig.drive().mode() == Mode::stopping) {
      ASSERT_TRUE(rig.powered());
      rig.step();
    }
    EXPECT_EQ(rig.drive().mode(), Mode::idle);
    EXPECT_LT(std::abs(rig.drive().twist().v_umps), 5'000);
  }
}

// 0.4 m/s^2 against the gains of a robot that nobody has tuned: the set point is at rest, the wheels are not.
TEST(Stopping, WheelsThatRollOnASecondAfterTheirSetPointStandsAreAFault) {
  DriveRig rig(support::mismatched_robot(), with({{Param::kp, q16(5)}, {Param::ki, 0}}));
  rig.hold_velocity(0.3, 0);
  rig.run_ms(1500);
  for (const Side side : {Side::left, Side::right}) rig.board().set_load(side, {.torque_Nm = 0.25});
  rig.release();
  rig.drive().stop();
  int set_point_ms = 0;
  while (rig.drive().wheels().set_points().left_umps != 0 && set_point_ms < 5000) {
    rig.step();
    ++set_point_ms;
  }
  int after_ms = 0;
  while (rig.powered() && after_ms < 5000) {
    rig.step();
    ++after_ms;
  }
  EXPECT_NEAR(after_ms, 1000, 10) << "the table says 1000 ms; looked at every 8";
  EXPECT_EQ(rig.drive().faults().first(), Fault::stop_timeout);
  EXPECT_EQ(rig.drive().mode(), Mode::fault);
}

TEST(Stopping, ARobotWithAGentleRampIsGivenItsTimeWhileItsHostIsThere) {
  DriveRig rig(support::mismatched_robot(), with({{Param::acceleration_limit, 100'000}}));
  rig.hold_velocity(0.5, 0);
  rig.run_ms(7000);
  rig.release();
  rig.drive().stop();
  const int ms = powered_for_ms(rig);
  EXPECT_NEAR(ms, 5000, 300) << "0.5 m/s at 0.1 m/s^2, and what the wheels take to settle";
  EXPECT_EQ(rig.drive().faults().mask(), 0U);
  EXPECT_EQ(rig.drive().mode(), Mode::idle);
}

TEST(Stopping, AHostThatFallsSilentInAGentleRampIsALostLinkWhateverTheTimeOut) {
  for (const std::int32_t timeout_ms : {0, 200, 60'000}) {
    DriveRig rig(support::mismatched_robot(),
                 with({{Param::acceleration_limit, 100'000}, {Param::command_timeout, timeout_ms}}));
    rig.hold_velocity(0.5, 0);
    rig.run_ms(7000);
    rig.release();
    rig.drive().stop();
    rig.silent = true;
    EXPECT_NEAR(powered_for_ms(rig), 2500, 10) << "looked at every 8 ms";
    EXPECT_EQ(rig.drive().faults().mask(), bit(Fault::link_lost));
  }
}

TEST(Stopping, AHostNeedNotSayMoreThanStop) {
  DriveRig rig;
  drive_and_stop(rig, 1500);
  rig.silent = true;
  rig.run_ms(1500);
  EXPECT_EQ(rig.drive().mode(), Mode::idle);
  EXPECT_EQ(rig.drive().faults().mask(), 0U);
}

TEST(Stopping, StoppingAgainAndAgainDoesNotPutTheDeadlineOff) {
  DriveRig rig(support::mismatched_robot(), with({{Param::kp, q16(5)}, {Param::ki, 0}}));
  for (const Side side : {Side::left, Side::right}) rig.board().set_load(side, {.torque_Nm = 0.25});
  drive_and_stop(rig, 1500);
  int ms = 0;
  for (; ms < 5000 && rig.powered(); ++ms) {
    rig.drive().stop();
    rig.step();
  }
  EXPECT_LT(ms, 2000);
  EXPECT_EQ(rig.drive().faults().first(), Fault::stop_timeout);
}

TEST(Stopping, AnArmedRobotWhoseHostIsGoneOpensItsBridges) {
  DriveRig rig;
  rig.silent = true;
  rig.run_ms(2400);
  EXPECT_EQ(rig.drive().mode(), Mode::idle);
  rig.run_ms(200);
  EXPECT_EQ(rig.drive().mode(), Mode::fault);
  EXPECT_EQ(rig.drive().faults().mask(), bit(Fault::link_lost));
}

TEST(Stopping, AnArmedRobotWaitsForAHostThatIsThereAndWhereTheTimeOutIsOff) {
  DriveRig rig;
  rig.run_ms(20'000);
  EXPECT_EQ(rig.drive().mode(), Mode::idle);
  DriveRig patient(support::mismatched_robot(), with({{Param::command_timeout, 0}}));
  patient.silent = true;
  patient.run_ms(20'000);
  EXPECT_EQ(patient.drive().mode(), Mode::idle);
}

}  // namespace
}  // namespace astro
