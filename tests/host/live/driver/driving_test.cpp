#include "host/live/driver/driving.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace astro::live {
namespace {

using std::chrono::milliseconds;
using Due = VelocityCommand::Due;
using testing::HasSubstr;

constexpr microseconds kTimeout = milliseconds(500), kRefresh = milliseconds(50);
constexpr Moment kNow{std::chrono::seconds(100), 1'790'000'000'000'000'000};

ros2::msg::Twist twist(double v_mps, double omega_radps) {
  ros2::msg::Twist twist;
  twist.linear.x = v_mps;
  twist.angular.z = omega_radps;
  return twist;
}

ros2::msg::TwistStamped stamped(milliseconds age) {
  ros2::msg::TwistStamped message;
  message.header.stamp = ros2::msg::to_time(kNow.utc_ns - 1'000'000 * age.count());
  message.twist = twist(0.3, 0);
  return message;
}

Moment later(milliseconds by) { return {kNow.steady + by, kNow.utc_ns + 1'000'000 * by.count()}; }

class Command : public testing::Test {
 protected:
  Due due(milliseconds after) { return command.due(later(after).steady, kRefresh); }
  VelocityCommand command{kTimeout};
};

TEST_F(Command, NothingIsDueBeforeTheFirst) { EXPECT_EQ(due(milliseconds(0)), Due::nothing); }

TEST_F(Command, ATwistIsDueAtOnceAndAgainAfterTheRefresh) {
  EXPECT_EQ(command.take(twist(0.25, -0.5), kNow), std::nullopt);
  EXPECT_EQ(due(milliseconds(0)), Due::velocity);
  EXPECT_EQ(command.velocity(), (protocol::Velocity{250'000, -500'000}));
  EXPECT_EQ(due(milliseconds(49)), Due::nothing);
  EXPECT_EQ(due(milliseconds(50)), Due::velocity);
}

TEST_F(Command, ANewVelocityDoesNotWaitForTheRefresh) {
  command.take(twist(0.25, 0), kNow);
  due(milliseconds(0));
  command.take(twist(0.3, 0), later(milliseconds(1)));
  EXPECT_EQ(due(milliseconds(1)), Due::velocity);
  EXPECT_EQ(command.velocity().v_umps, 300'000);
}

TEST_F(Command, AfterTheTimeOutStopIsDueOnce) {
  command.take(twist(0.25, 0), kNow);
  due(milliseconds(480));
  EXPECT_EQ(due(milliseconds(499)), Due::nothing);
  EXPECT_EQ(due(milliseconds(500)), Due::stop);
  EXPECT_EQ(due(milliseconds(501)), Due::nothing);
}

TEST_F(Command, WithoutAStampHoldsFromTheEarliestMomentAtWhichItCanHaveCome) {
  Moment after_work = kNow;
  after_work.waited = milliseconds(300);
  EXPECT_EQ(command.take(twist(0.25, 0), after_work), std::nullopt);
  EXPECT_EQ(due(milliseconds(199)), Due::velocity);
  EXPECT_EQ(due(milliseconds(200)), Due::stop);
}

TEST_F(Command, WithoutAStampIsRefusedIfItMayHaveWaitedForTheTimeOut) {
  Moment after_work = kNow;
  after_work.waited = milliseconds(500);
  EXPECT_THAT(command.take(twist(0.25, 0), after_work).value_or(""), HasSubstr("waited for 0.5 s"));
  EXPECT_EQ(due(milliseconds(0)), Due::nothing);
}

TEST_F(Command, NanAndInfinityAreRefusedInAnyComponent) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (double ros2::msg::Vector3::*component :
         {&ros2::msg::Vector3::x, &ros2::msg::Vector3::y, &ros2::msg::Vector3::z}) {
      for (ros2::msg::Vector3 ros2::msg::Twist::*part :
           {&ros2::msg::Twist::linear, &ros2::msg::Twist::angular}) {
        ros2::msg::Twist message = twist(0.1, 0.1);
        message.*part.*component = bad;
        EXPECT_THAT(command.take(message, kNow).value_or(""), HasSubstr("NaN or infinity"));
      }
    }
  }
  EXPECT_EQ(due(milliseconds(0)), Due::nothing);
}

TEST_F(Command, ARefusedOneLeavesTheOneBeforeInForce) {
  command.take(twist(0.25, 0), kNow);
  EXPECT_TRUE(command.take(twist(std::nan(""), 0), kNow));
  EXPECT_EQ(due(milliseconds(0)), Due::velocity);
  EXPECT_EQ(command.velocity().v_umps, 250'000);
}

TEST_F(Command, AStampOfZeroMeansNow) {
  ros2::msg::TwistStamped message;
  message.twist = twist(0.3, 0);
  EXPECT_EQ(command.take(message, kNow), std::nullopt);
  EXPECT_EQ(due(milliseconds(499)), Due::velocity);
  EXPECT_EQ(due(milliseconds(500)), Due::stop);
}

TEST_F(Command, AStampOlderThanTheTimeOutIsRefused) {
  EXPECT_THAT(command.take(stamped(milliseconds(501)), kNow).value_or(""), HasSubstr("0.501 s old"));
  EXPECT_EQ(command.take(stamped(milliseconds(499)), kNow), std::nullopt);
}

TEST_F(Command, AStampFromTheFutureIsRefusedBeyondATenthOfASecond) {
  EXPECT_THAT(command.take(stamped(milliseconds(-101)), kNow).value_or(""), HasSubstr("in the future"));
  EXPECT_EQ(command.take(stamped(milliseconds(-99)), kNow), std::nullopt);
}

TEST_F(Command, HoldsFromItsStampAndNotFromWhenItCame) {
  command.take(stamped(milliseconds(300)), kNow);
  EXPECT_EQ(due(milliseconds(199)), Due::velocity);
  EXPECT_EQ(due(milliseconds(200)), Due::stop);
}

TEST_F(Command, OneFromTheFutureHoldsNoLongerThanTheTimeOut) {
  command.take(stamped(milliseconds(-90)), kNow);
  EXPECT_EQ(due(milliseconds(500)), Due::stop);
}

TEST_F(Command, FasterThanAMessageCanHoldKeepsItsCurvature) {
  command.take(twist(1e9, -5e8), kNow);
  EXPECT_EQ(due(milliseconds(0)), Due::velocity);
  EXPECT_EQ(command.velocity(), (protocol::Velocity{2'000'000'000, -1'000'000'000}));
}

TEST_F(Command, WhatADifferentialDriveCannotDoIsIgnored) {
  ros2::msg::Twist message = twist(0.1, 0.2);
  message.linear.y = 3;
  message.angular.x = 4;
  EXPECT_EQ(command.take(message, kNow), std::nullopt);
  EXPECT_EQ(due(milliseconds(0)), Due::velocity);
  EXPECT_EQ(command.velocity(), (protocol::Velocity{100'000, 200'000}));
}

}  // namespace
}  // namespace astro::live
