#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/robots/hand_fed_drive.hpp"

// Each threshold of drive and wheels, tested just inside and just outside. The numbers are repeated here, so
// that a changed constant is noticed.
namespace astro {
namespace {

using support::fine_encoders;
using support::HandFedDrive;
using support::kFineCount_umps;
using support::without_feedback;

struct Sides {
  const char* name;
  int left, right;
};

// ---- when a wheel counts as stopped: 3 mm/s

TEST(Standing, IsSlowerThanThreeMillimetresASecondOnEachWheel) {
  static_assert(38 * kFineCount_umps < 3'000 && 39 * kFineCount_umps > 3'000);
  for (const Sides& side :
       {Sides{"left", 1, 0}, {"right", 0, 1}, {"left back", -1, 0}, {"right back", 0, -1}}) {
    HandFedDrive rig(fine_encoders());
    rig.ticks(300, 38 * side.left, 38 * side.right);
    EXPECT_TRUE(rig.drive().stopped_without_power()) << side.name;
    rig.ticks(300, 39 * side.left, 39 * side.right);
    EXPECT_FALSE(rig.drive().stopped_without_power())
        << side.name << ": the robot turns about the other wheel";
  }
}

TEST(Standing, ARobotThatTurnsAboutOneWheelStopsOnlyWhenTheOtherStandsToo) {
  for (const Sides& rolls : {Sides{"left", 40, 0}, {"right", 0, 40}}) {
    HandFedDrive rig(fine_encoders());
    rig.arm();
    rig.velocity = BodyTwist{1'000, 0};
    rig.ticks(150, rolls.left, rolls.right);
    rig.velocity.reset();
    rig.drive().stop();
    rig.ticks(150, rolls.left, rolls.right);  // the ramp itself is over after a few ticks
    EXPECT_EQ(rig.drive().state(), State::stopping) << rolls.name;
    rig.ticks(200);
    EXPECT_EQ(rig.drive().state(), State::armed) << rolls.name;
  }
}

TEST(Standing, AVelocityBeginsFromRestOnlyIfBothWheelsStand) {
  for (const int counts : {38, 39}) {
    HandFedDrive rig(fine_encoders());
    rig.arm();
    rig.ticks(300, counts, 0);
    rig.drive().drive_velocity({1, 0});
    rig.tick(counts, 0);
    // The ramp begins at the wheels' speed, or at zero.
    EXPECT_EQ(rig.drive().wheels().set_points().left_umps > 1'000, counts == 39) << counts;
  }
}

// ---- what ends a segment: stopped and close for 50 ms, or 700 ms are over

class Dwelling : public testing::Test {
 protected:
  static constexpr int kDwell_ms = 100;
  // A segment ends in one tick of ten, in the mean 5 later; 2 for the ticks at both ends.
  static constexpr int kUntilBoundary = 5, kAround = 5 + 2;

  /// Ticks from the end of the profile to the end of the segment, with so many counts in each; 0 if it does
  /// not end within two seconds.
  static int settling_ticks(HandFedDrive& rig, std::int32_t left, std::int32_t right) {
    EXPECT_TRUE(rig.drive().add_segment({.dwell_ms = kDwell_ms}, 7));
    rig.tick();                // its profile is made
    rig.ticks(kDwell_ms - 1);  // it stands
    EXPECT_EQ(rig.drive().running_tag(), 7);
    for (int i = 0; i < 2'000; ++i) {
      rig.tick(i % 2 == 0 ? left : 0, i % 2 == 0 ? right : 0);
      if (rig.drive().running_tag() != 7) return i + 1;
    }
    return 0;
  }
};

TEST_F(Dwelling, IsSettledAfterFiftyTicksOfStanding) {
  HandFedDrive rig(fine_encoders());
  rig.arm();
  EXPECT_NEAR(settling_ticks(rig, 0, 0), 50 + kUntilBoundary, kAround);
}

TEST_F(Dwelling, IsOverAfterSevenTenthsOfASecondWhateverTheWheelsDo) {
  for (const Sides& rolls : {Sides{"left", 80, 0}, {"right", 0, 80}}) {  // 3.2 mm/s in the mean
    HandFedDrive rig(without_feedback(fine_encoders()));
    rig.arm();
    for (int segment = 0; segment < 2; ++segment)  // each from its own end
      EXPECT_NEAR(settling_ticks(rig, rolls.left, rolls.right), 700 + kUntilBoundary, kAround)
          << rolls.name << ' ' << segment;
    EXPECT_EQ(rig.drive().faults().mask(), 0U);
  }
}

// ---- when a robot counts as carried away: 50 mm to any side, or 1/64 turn

class CarriedWhilePaused : public testing::Test {
 protected:
  /// The robot pauses, is carried along its heading and turned, and resumes. True if it drives back to its
  /// path. The heading is `quarters` quarter turns.
  static bool hurries_back(int quarters, double ahead_mm, double turned_rad) {
    HandFedDrive rig;
    rig.drive().set_pose({1000, -1000, Angle::from_raw(static_cast<std::uint64_t>(quarters) << 62), 0});
    rig.arm();
    EXPECT_TRUE(rig.drive().add_segment({.dwell_ms = 1000}, 1));
    rig.ticks(100);
    EXPECT_TRUE(rig.drive().pause());
    rig.ticks(300);
    EXPECT_EQ(rig.drive().mode(), protocol::Mode::paused);
    // 12.39 counts are a millimetre; 10 a tick are 0.8 m/s.
    const int ahead = static_cast<int>(std::lround(ahead_mm * 12.3929)), sign = ahead < 0 ? -1 : 1;
    for (int left = std::abs(ahead); left > 0; left -= 10)
      rig.tick(sign * std::min(left, 10), sign * std::min(left, 10));
    const int turn = static_cast<int>(std::lround(turned_rad * 145 * 12.3929)), sense = turn < 0 ? -1 : 1;
    for (int left = std::abs(turn); left > 0; left -= 10)
      rig.tick(-sense * std::min(left, 10), sense * std::min(left, 10));
    rig.ticks(500);
    rig.drive().resume();
    rig.ticks(20);  // it begins within ten and is corrected within five more
    EXPECT_EQ(rig.drive().mode(), protocol::Mode::segment);
    const WheelSpeeds set = rig.drive().wheels().set_points();
    return std::abs(set.left_umps) > 50'000 || std::abs(set.right_umps) > 50'000;
  }
};

TEST_F(CarriedWhilePaused, ByLessThanFiftyMillimetresItGoesBackByMoreItDoesNot) {
  for (int quarters = 0; quarters < 4; ++quarters)
    for (const double way : {-1.0, 1.0}) {
      EXPECT_TRUE(hurries_back(quarters, way * 48, 0)) << quarters << ' ' << way;
      EXPECT_FALSE(hurries_back(quarters, way * 52, 0)) << quarters << ' ' << way;
    }
}

TEST_F(CarriedWhilePaused, TurnedByLessThanASixtyFourthOfATurnItTurnsBackByMoreItDoesNot) {
  for (const double way : {-1.0, 1.0}) {
    EXPECT_TRUE(hurries_back(0, 0, way * 0.094)) << way;  // 1/64 turn is 0.0982 rad
    EXPECT_FALSE(hurries_back(0, 0, way * 0.102)) << way;
  }
}

// ---- the supply

/// Duty of 100 mV on both motors, of 32767.
int duty_of_a_tenth_volt(std::int32_t battery_mv) {
  HandFedDrive rig;
  rig.arm();
  rig.battery_mv = battery_mv;
  rig.voltages = WheelVoltages{100'000, 100'000};
  const Drive::Output output = rig.tick();
  EXPECT_EQ(output.duty.left, output.duty.right);
  return output.duty.left;
}

TEST(LeastSupply, OfOneVoltIsWhatAnySmallerReadingCountsAs) {
  EXPECT_NEAR(duty_of_a_tenth_volt(1'100), 32'767 / 11, 1);
  EXPECT_NEAR(duty_of_a_tenth_volt(1'000), 32'767 / 10, 1);
  for (const int below_mv : {950, 500, 1, 0, -12'000})
    EXPECT_NEAR(duty_of_a_tenth_volt(below_mv), 32'767 / 10, 1);
}

TEST(Supply, IsTheMostThatTheMotorsGetUnlessTheyStandLess) {
  for (const std::int32_t most_mv : {6'000, 11'000, 12'000, 50'000}) {
    ParameterSet set;
    set.set(Param::motor_voltage_max, most_mv);
    for (const std::int32_t sign : {-1, 1}) {
      HandFedDrive rig(set);
      rig.arm();
      rig.voltages = WheelVoltages{sign * 50'000'000, -sign * 50'000'000};
      const Drive::Output output = rig.tick();
      EXPECT_NEAR(output.duty.left, sign * 32'767.0 * std::min(most_mv, 12'000) / 12'000, 1) << most_mv;
      EXPECT_NEAR(output.duty.right, -sign * 32'767.0 * std::min(most_mv, 12'000) / 12'000, 1) << most_mv;
    }
  }
}

// ---- what an encoder may count in one tick

/// Whether the robot accepts so many counts in one tick, of each wheel and in both directions.
bool believed(const ParameterSet& set, std::int32_t counts, bool on_time) {
  int taken = 0;
  for (const Sides& side : {Sides{"left", 1, 0}, {"right", 0, 1}, {"left", -1, 0}, {"right", 0, -1}}) {
    HandFedDrive rig(set);
    rig.ticks(50);
    rig.on_time = on_time;
    rig.tick(counts * side.left, counts * side.right);
    const bool refused = rig.has(Fault::encoder);
    const Wheels& wheels = rig.drive().wheels();
    EXPECT_EQ(wheels.left_counts(), refused ? 0 : counts * side.left);
    EXPECT_EQ(wheels.right_counts(), refused ? 0 : counts * side.right);
    taken += refused ? 0 : 1;
  }
  EXPECT_TRUE(taken == 0 || taken == 4) << counts << ": one wheel like the other";
  return taken != 0;
}

TEST(MostCounts, OfATickOnTimeIsFourTimesOverSpeedAndTwo) {
  ParameterSet set;  // 1.2 m/s, and 12.39 counts a millimetre: 4.8 mm are 59.49 counts
  EXPECT_TRUE(believed(set, 61, true));
  EXPECT_FALSE(believed(set, 62, true));
  set.set(Param::over_speed, 800'000);  // 39.66 counts
  EXPECT_TRUE(believed(set, 41, true));
  EXPECT_FALSE(believed(set, 42, true));
}

TEST(MostCounts, OfATickOnTimeGoByTheWheelOfFinerCounts) {
  for (const Param finer : {Param::c_L, Param::c_R}) {
    ParameterSet set;
    set.set(finer, 1 << 29);  // counts of half the travel: 118.98 in 4.8 mm
    EXPECT_TRUE(believed(set, 120, true));
    EXPECT_FALSE(believed(set, 121, true));
  }
}

TEST(MostCounts, OfALateTickIsAThousand) {
  EXPECT_TRUE(believed({}, 1000, false));
  EXPECT_FALSE(believed({}, 1001, false));
}

TEST(MostCounts, OfCoarseEncodersIsASixteenthOfATurnByTheCoarserWheel) {
  ParameterSet set;
  set.set(Param::gear_numerator, 10);  // a count is 3.534 mm, and 1 / 515.6 turn of the robot
  EXPECT_TRUE(believed(set, 32, false));
  EXPECT_FALSE(believed(set, 33, false));
  set.set(Param::e, -(1 << 30) / 5);  // curves turn about 0.8 b: 25.78 counts
  EXPECT_TRUE(believed(set, 25, false));
  EXPECT_FALSE(believed(set, 26, false));
  set.set(Param::e, (1 << 30) / 5);  // spins still turn about b
  EXPECT_TRUE(believed(set, 32, false));
  EXPECT_FALSE(believed(set, 33, false));
  set.set(Param::e, 0);
  set.set(Param::gear_numerator, 330);  // more than the thousand that any late tick may count
  EXPECT_TRUE(believed(set, 1000, false));
  EXPECT_FALSE(believed(set, 1001, false));
  set.set(Param::gear_numerator, 295);  // just less than the thousand that any late tick may count
  EXPECT_TRUE(believed(set, 950, false));
  EXPECT_FALSE(believed(set, 951, false));
  set.set(Param::gear_numerator, 10);
  for (const Param coarser : {Param::c_L, Param::c_R}) {
    ParameterSet unlike = set;
    unlike.set(coarser, 5 << 28);  // 1.25: 25.78 counts
    EXPECT_TRUE(believed(unlike, 25, false));
    EXPECT_FALSE(believed(unlike, 26, false));
  }
}

// ---- counting itself

TEST(Decoders, MayStandAtAnyNumbersWhenTheRobotStarts) {
  for (const hal::EncoderCounts& start :
       {hal::EncoderCounts{1'000'000, -7}, {-7, 1'000'000}, {INT32_MAX, INT32_MIN}, {5, 5}}) {
    HandFedDrive rig({}, start);
    rig.ticks(10);
    EXPECT_EQ(rig.drive().faults().mask(), 0U);
    EXPECT_EQ(rig.drive().pose(), Pose{});
    EXPECT_EQ(rig.drive().wheels().left_counts(), 0);
    EXPECT_EQ(rig.drive().wheels().right_counts(), 0);
    rig.ticks(10, 3, -2);  // INT32_MAX is passed on the way
    EXPECT_EQ(rig.drive().wheels().left_counts(), 30);
    EXPECT_EQ(rig.drive().wheels().right_counts(), -20);
  }
}

TEST(Decoders, CountsToEitherSideAreEdgesAndTheDifferenceIsTheWay) {
  HandFedDrive rig;
  rig.tick();
  for (int i = 0; i < 5; ++i) {
    rig.tick(3, -1);
    rig.tick(-2, 1);
  }
  const Wheels& wheels = rig.drive().wheels();
  EXPECT_EQ(wheels.left_counts(), 5);
  EXPECT_EQ(wheels.right_counts(), 0);
  EXPECT_EQ(wheels.left_edges(), 25U);
  EXPECT_EQ(wheels.right_edges(), 10U);
}

}  // namespace
}  // namespace astro
