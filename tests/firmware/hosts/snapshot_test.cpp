#include "firmware/app/hosts/snapshot.hpp"

#include <gtest/gtest.h>

#include "tests/support/robots/hand_fed_drive.hpp"

// Telemetry of a robot whose wheels do different things, so that a mix-up of left and right shows.
namespace astro {
namespace {

using protocol::Telemetry;
using support::HandFedDrive;

class Snapshot : public testing::Test {
 protected:
  Snapshot() {
    rig_.arm();
    rig_.velocity = BodyTwist{300'000, 500'000};  // 227.5 mm/s on the left, 372.5 mm/s on the right
  }
  Telemetry taken() { return snapshot(rig_.drive(), 123'456'789'012, 11'987); }

  HandFedDrive rig_{support::without_feedback()};
};

TEST_F(Snapshot, CountsAndSpeedsAreThoseOfTheirOwnWheels) {
  rig_.ticks(1500, 2, 5);
  const Telemetry telemetry = taken();
  EXPECT_EQ(telemetry.counts.left, 3000);
  EXPECT_EQ(telemetry.counts.right, 7500);
  // 12.3929 counts are a millimetre.
  EXPECT_NEAR(telemetry.wheel_speed.left_umps, 2e6 / 12.3929, 20);
  EXPECT_NEAR(telemetry.wheel_speed.right_umps, 5e6 / 12.3929, 20);
  EXPECT_NEAR(telemetry.twist.v_umps, 3.5e6 / 12.3929, 20);
  EXPECT_NEAR(telemetry.twist.omega_uradps, 3e6 / 12.3929 / 0.290, 100);
}

TEST_F(Snapshot, SetPointsAreThoseOfTheirOwnWheels) {
  rig_.ticks(1500, 3, 5);  // the ramp is over after 0.7 s
  const Telemetry telemetry = taken();
  EXPECT_EQ(telemetry.setpoint.left_umps, 227'500);
  EXPECT_EQ(telemetry.setpoint.right_umps, 372'500);
}

TEST_F(Snapshot, DutiesAreThoseOfTheirOwnWheelsForwardPositive) {
  ParameterSet set;
  set.set(Param::motor_polarity_left, -1);
  HandFedDrive rig(set);
  rig.arm();
  rig.voltages = WheelVoltages{3'000'000, -6'000'000};
  rig.tick();
  const Telemetry telemetry = snapshot(rig.drive(), 0, 0);
  EXPECT_NEAR(telemetry.duty.left, 32'767 / 4, 1);
  EXPECT_NEAR(telemetry.duty.right, -32'767 / 2, 1);
  EXPECT_EQ(rig.output().duty.left, -telemetry.duty.left) << "the bridge is wired the other way round";
  EXPECT_EQ(rig.output().duty.right, telemetry.duty.right);
}

TEST_F(Snapshot, TheRestIsWhatTheDriveAndTheCallerSay) {
  rig_.drive().set_pose({5, -7, Angle::from_raw(std::uint64_t{3} << 62), 9});
  Telemetry telemetry = taken();
  EXPECT_EQ(telemetry.device_time_us, 123'456'789'012U);
  EXPECT_EQ(telemetry.battery.mv, 11'987);
  EXPECT_EQ(telemetry.pose.x, 5);
  EXPECT_EQ(telemetry.pose.y, -7);
  EXPECT_EQ(telemetry.pose.theta, std::uint64_t{3} << 62);
  EXPECT_EQ(telemetry.pose.turns, 9);
  EXPECT_EQ(telemetry.state.mode, protocol::Mode::idle);
  EXPECT_EQ(telemetry.state.latched_faults, 0U);
  rig_.drive().emergency_stop();
  telemetry = taken();
  EXPECT_EQ(telemetry.state.mode, protocol::Mode::fault);
  EXPECT_EQ(telemetry.state.latched_faults, bit(Fault::emergency_stop));
}

TEST_F(Snapshot, ThePathIsThatUnderWay) {
  rig_.velocity.reset();
  ASSERT_TRUE(rig_.drive().add_segment({.length_nm = 1'000'000'000}, 41));
  ASSERT_TRUE(rig_.drive().add_segment({.length_nm = 1'000'000'000}, 42));
  ASSERT_TRUE(rig_.drive().add_segment({.length_nm = 1'000'000'000}, 43));
  rig_.ticks(400, 0, 1);  // pushed to the left, while the reference goes straight on
  const Telemetry telemetry = taken();
  EXPECT_EQ(telemetry.state.tag, 41);
  EXPECT_EQ(telemetry.path.tag, 41);
  EXPECT_EQ(telemetry.path.queued, 2);
  // 0.25 m/s^2 t^2 after 0.4 s are 40 mm of a metre, and 38 if it began 10 ms later; 2^-15 is a unit.
  EXPECT_NEAR(telemetry.path.progress / 32768.0, 0.039, 0.002);
  EXPECT_LT(telemetry.path.cross_track_um, 0) << "the reference is to the right";
  // 400 counts of the right wheel are 32.28 mm, on 290 mm 0.1113 rad.
  // It began up to eleven ticks later, and the error is up to four ticks old.
  EXPECT_NEAR(telemetry.path.heading_error_urad, -111'300, 15 * 279);
}

}  // namespace
}  // namespace astro
