#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/robots/hand_fed_drive.hpp"

// What a request changes, and that a refused request changes nothing.
namespace astro {
namespace {

using support::HandFedDrive;
using support::without_feedback;

std::vector<std::uint16_t> aborted_tags(Drive& drive) {
  std::vector<std::uint16_t> tags;
  while (!drive.events().empty()) {
    const SegmentEvent event = drive.events().pop();
    if (event.kind == SegmentEvent::Kind::aborted) tags.push_back(event.tag);
  }
  return tags;
}

void add_stands(HandFedDrive& rig, int count) {
  for (int i = 1; i <= count; ++i)
    ASSERT_TRUE(rig.drive().add_segment({.dwell_ms = 1000}, static_cast<std::uint16_t>(i)));
}

TEST(Requests, WhateverOpensTheBridgesEmptiesTheQueueAndSaysSoOfEachSegment) {
  for (const bool fault : {false, true}) {
    HandFedDrive rig;
    rig.arm();
    add_stands(rig, 3);
    rig.ticks(10);
    ASSERT_EQ(rig.drive().running_tag(), 1);
    if (fault) {
      rig.drive().emergency_stop();
    } else {
      rig.drive().disarm();
    }
    EXPECT_EQ(rig.drive().queued(), 0U);
    EXPECT_EQ(rig.drive().running_tag(), 0);
    EXPECT_EQ(aborted_tags(rig.drive()), (std::vector<std::uint16_t>{1, 2, 3}));
    rig.drive().clear_faults();
    rig.drive().arm();
    rig.ticks(100);
    EXPECT_TRUE(aborted_tags(rig.drive()).empty());
    EXPECT_FALSE(rig.drive().gives_power()) << "nothing is left to drive";
  }
}

TEST(Requests, StopEmptiesAQueueThatWaitsInAPause) {
  HandFedDrive rig;
  rig.arm();
  ASSERT_TRUE(rig.drive().pause());
  add_stands(rig, 2);
  rig.ticks(10);
  rig.drive().stop();
  EXPECT_EQ(rig.drive().queued(), 0U);
  EXPECT_EQ(aborted_tags(rig.drive()), (std::vector<std::uint16_t>{1, 2}));
  EXPECT_EQ(rig.drive().mode(), protocol::Mode::idle) << "no longer paused";
}

TEST(Requests, AVelocityEndsAPause) {
  HandFedDrive rig(without_feedback());
  rig.arm();
  ASSERT_TRUE(rig.drive().pause());
  ASSERT_TRUE(rig.drive().drive_velocity({1'000, 0}));
  rig.ticks(10);
  rig.drive().stop();
  rig.ticks(300);
  EXPECT_EQ(rig.drive().mode(), protocol::Mode::idle);
  ASSERT_TRUE(rig.drive().pause());
  ASSERT_TRUE(rig.drive().drive_wheels({0, 0}));
  rig.drive().stop();
  rig.tick();
  EXPECT_EQ(rig.drive().mode(), protocol::Mode::idle);
}

TEST(Requests, NothingThatTheLoopSummedUpOutlivesItsDrive) {
  HandFedDrive rig;
  rig.arm();
  rig.velocity = BodyTwist{100'000, 0};
  rig.ticks(250);  // held at its wheels
  ASSERT_GT(rig.output().duty.left, 16'000);
  rig.velocity.reset();
  rig.drive().disarm();
  rig.tick();
  rig.drive().arm();
  rig.tick();
  ASSERT_TRUE(rig.drive().drive_velocity({1'000, 0}));
  rig.tick();
  // The feed-forward of friction is 0.5 V of 12 V, 1365.
  EXPECT_LT(rig.output().duty.left, 2'000);
  EXPECT_LT(rig.output().duty.right, 2'000);
}

TEST(Requests, VoltagesAreRefusedWhileALoopDrivesAndChangeNothing) {
  HandFedDrive rig(without_feedback());
  rig.arm();
  ASSERT_TRUE(rig.drive().drive_velocity({100'000, 0}));
  rig.ticks(20);
  EXPECT_FALSE(rig.drive().drive_wheels({12'000'000, 12'000'000}));
  EXPECT_EQ(rig.drive().mode(), protocol::Mode::velocity);
  rig.drive().disarm();
  rig.drive().arm();
  add_stands(rig, 2);
  rig.ticks(10);
  EXPECT_FALSE(rig.drive().drive_wheels({12'000'000, 12'000'000}));
  EXPECT_EQ(rig.drive().mode(), protocol::Mode::segment);
  EXPECT_EQ(rig.drive().queued(), 1U);
}

TEST(Requests, APlanIsWantedOfTheFrontOfTheQueueOnceAndOfNothingElse) {
  HandFedDrive rig;
  Segment segment;
  std::uint8_t ticket = 0;
  rig.arm();
  EXPECT_FALSE(rig.drive().wants_plan(segment, ticket)) << "nothing is queued";
  ASSERT_TRUE(rig.drive().pause());
  ASSERT_TRUE(rig.drive().add_segment({.dwell_ms = 77}, 1));
  ASSERT_TRUE(rig.drive().wants_plan(segment, ticket));
  EXPECT_EQ(segment.dwell_ms, 77);
  rig.drive().plan();
  EXPECT_FALSE(rig.drive().wants_plan(segment, ticket)) << "it is there";
}

TEST(Requests, APlanThatComesLateIsOfASegmentThatIsGone) {
  HandFedDrive rig;
  rig.arm();
  ASSERT_TRUE(rig.drive().pause());
  ASSERT_TRUE(rig.drive().add_segment({.dwell_ms = 10}, 1));
  Segment segment;
  std::uint8_t ticket = 0;
  ASSERT_TRUE(rig.drive().wants_plan(segment, ticket));
  Trapezoid old;
  ASSERT_TRUE(Trapezoid::plan(segment, make_limits({}), old));
  rig.drive().stop();
  ASSERT_TRUE(rig.drive().add_segment({.dwell_ms = 500}, 2));
  rig.drive().take_plan(old, ticket);
  EXPECT_TRUE(rig.drive().wants_plan(segment, ticket))
      << "the profile of the first is not taken for the second";
  EXPECT_EQ(segment.dwell_ms, 500);
}

/// The fastest set point of a wheel in so many ticks.
std::int32_t fastest_umps(HandFedDrive& rig, int ticks) {
  std::int32_t fastest = 0;
  for (int i = 0; i < ticks; ++i) {
    rig.tick();
    const WheelSpeeds set = rig.drive().wheels().set_points();
    fastest = std::max({fastest, std::abs(set.left_umps), std::abs(set.right_umps)});
  }
  return fastest;
}

TEST(Requests, WhatAPauseLeavesOfASegmentKeepsItsOwnSpeed) {
  struct Case {
    Segment segment;
    int speed_umps;  // of a wheel: 0.29 m / 2 * 0.2 rad/s are 29 mm/s
  };
  for (const Case& one : {Case{{.length_nm = 400'000'000, .speed_umps = 50'000}, 50'000},
                          Case{{.angle_32 = std::int64_t{1} << 31, .yaw_rate_uradps = 200'000}, 29'000}}) {
    HandFedDrive rig(without_feedback());
    rig.arm();
    ASSERT_TRUE(rig.drive().add_segment(one.segment, 1));
    EXPECT_NEAR(fastest_umps(rig, 1000), one.speed_umps, 100);
    ASSERT_TRUE(rig.drive().pause());
    rig.ticks(1500);
    ASSERT_EQ(rig.drive().mode(), protocol::Mode::paused);
    rig.drive().resume();
    EXPECT_NEAR(fastest_umps(rig, 1000), one.speed_umps, 100);
  }
}

TEST(Requests, TheSpeedOfEachWheelFollowsAnAccelerationThatItsOwnCountsShow) {
  // The observer gets the acceleration in counts of each wheel. With very different counts a mix-up of the
  // wheels shows.
  for (const bool left_is_small : {false, true}) {
    ParameterSet set = without_feedback();
    set.set(Param::counts_per_motor_rev, 2048);
    set.set(left_is_small ? Param::c_L : Param::c_R, 1 << 29);
    set.set(left_is_small ? Param::c_R : Param::c_L, 3 << 29);
    const double left_um = 2.5216 * (left_is_small ? 0.5 : 1.5);  // a count: pi * 72 mm / (2048 * 43.8)
    const double right_um = 2.5216 * (left_is_small ? 1.5 : 0.5);
    HandFedDrive rig(set);
    rig.arm();
    rig.velocity = BodyTwist{400'000, 0};
    double left = 0, right = 0;
    for (int i = 0; i < 700; ++i) {
      const WheelSpeeds wanted = rig.drive().wheels().set_points();
      const double left_before = std::floor(left), right_before = std::floor(right);
      left += wanted.left_umps * 0.001 / left_um;
      right += wanted.right_umps * 0.001 / right_um;
      rig.tick(static_cast<int>(std::floor(left) - left_before),
               static_cast<int>(std::floor(right) - right_before));
      if (i < 300) continue;  // the jerk, and the observer
      // With the other wheel's counts the error would be 3 mm/s and 10 mm/s, without any 2 a / w = 5 mm/s.
      // The allowed error is one count, 3.8 mm/s in a tick before smoothing.
      ASSERT_NEAR(rig.drive().wheels().speeds().left_umps, wanted.left_umps, 2'500) << i;
      ASSERT_NEAR(rig.drive().wheels().speeds().right_umps, wanted.right_umps, 2'500) << i;
    }
  }
}

}  // namespace
}  // namespace astro
