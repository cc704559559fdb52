#include "common/protocol/driving_rule.hpp"

#include <gtest/gtest.h>

#include <array>

// Who may move the robot, row by row of the rule. Hosts are numbers here.
namespace astro::protocol {
namespace {

constexpr int kDriver = 1, kOther = 2, kThird = 3;
constexpr std::array kVelocities{Velocity::kId, WheelVoltage::kId, Rest::kId};
constexpr std::array kPaths{AddSegment::kId};

class Rule : public testing::Test {
 protected:
  Rule() { rule.note(kDriver, Arm::kId); }

  /// What the driver may do.
  void expect(bool velocities, bool paths, bool resume) {
    for (const std::uint8_t each : kVelocities)
      EXPECT_EQ(rule.permits(kDriver, each), velocities) << int{each};
    for (const std::uint8_t each : kPaths) EXPECT_EQ(rule.permits(kDriver, each), paths) << int{each};
    EXPECT_EQ(rule.permits(kDriver, Resume::kId), resume);
  }

  DrivingRule<int> rule;
};

TEST_F(Rule, NobodyMovesARobotThatNobodyHasArmed) {
  const DrivingRule<int> fresh;
  for (const std::uint8_t each : kVelocities) EXPECT_FALSE(fresh.permits(kDriver, each));
  for (const std::uint8_t each : kPaths) EXPECT_FALSE(fresh.permits(kDriver, each));
}

TEST_F(Rule, TheHostThatArmedLastDrivesAndNobodyElse) {
  expect(true, true, true);
  for (const std::uint8_t each : kVelocities) EXPECT_FALSE(rule.permits(kOther, each));
  for (const std::uint8_t each : kPaths) EXPECT_FALSE(rule.permits(kOther, each));
  rule.note(kOther, Arm::kId);
  expect(false, false, true);
  EXPECT_TRUE(rule.permits(kOther, Velocity::kId));
  rule.note(kThird, Stop::kId);
  EXPECT_TRUE(rule.permits(kThird, Resume::kId)) << "it resumes nothing, because a stop empties the queue";
}

TEST_F(Rule, AskingAndHaltingIsForEverybodyAlways) {
  rule.note(kOther, Stop::kId);
  for (const std::uint8_t each : {Ping::kId, GetStatus::kId, Arm::kId, Disarm::kId, Stop::kId,
                                  EmergencyStop::kId, Pause::kId, ClearFaults::kId})
    for (const int host : {kDriver, kOther}) EXPECT_TRUE(rule.permits(host, each)) << int{each};
}

TEST_F(Rule, AfterAStopOfAnybodyItTakesAnArm) {
  for (const std::uint8_t halt : {Stop::kId, Disarm::kId, EmergencyStop::kId}) {
    for (const int by : {kDriver, kOther}) {
      rule.note(by, halt);
      EXPECT_TRUE(rule.stopped());
      expect(false, false, false);
      rule.note(kOther, Resume::kId);
      expect(false, false, false);
      rule.note(kDriver, Arm::kId);
      expect(true, true, true);
    }
  }
}

TEST_F(Rule, WhilePausedByAnotherTheDriversPathGrowsAndOnlyOthersResumeIt) {
  rule.note(kOther, Pause::kId);
  expect(false, true, false);
  EXPECT_TRUE(rule.permits(kThird, Resume::kId));
  rule.note(kThird, Resume::kId);
  expect(true, true, true);
}

TEST_F(Rule, ADriverResumesItsOwnPauseUnlessAnotherHasPausedToo) {
  rule.note(kDriver, Pause::kId);
  expect(false, true, true);
  rule.note(kOther, Pause::kId);
  expect(false, true, false);
  rule.note(kDriver, Pause::kId);
  expect(false, true, false);
  rule.note(kDriver, Arm::kId);
  expect(true, true, true);
}

TEST_F(Rule, AStopWithinAPauseIsNotEndedByResume) {
  rule.note(kOther, Pause::kId);
  rule.note(kOther, Stop::kId);
  rule.note(kOther, Resume::kId);
  expect(false, false, false);
}

TEST_F(Rule, WhenTheDriverHasGoneNobodyDrives) {
  rule.end();
  EXPECT_EQ(rule.driver(), std::nullopt);
  expect(false, false, false);
  EXPECT_FALSE(rule.permits(kOther, Resume::kId));
}

TEST_F(Rule, RestAndMotionKeepThePermission) {
  for (const std::uint8_t each : {Rest::kId, Velocity::kId, AddSegment::kId, WheelVoltage::kId}) {
    rule.note(kDriver, each);
    expect(true, true, true);
  }
}

}  // namespace
}  // namespace astro::protocol
