#include <gtest/gtest.h>

#include "tests/support/robots/bench_robot.hpp"

namespace astro {
namespace {

using protocol::ErrorCode;

class Parameters : public support::RobotOnBench {
 protected:
  static std::uint16_t id(Param param) { return static_cast<std::uint16_t>(param); }
  /// Opens the staging area for the client, at port 0.
  void open_staging() { ask(protocol::RevertParameters{}); }
  void stage(Param param, std::int32_t raw) { ask(protocol::StageParameter{id(param), raw, {}}); }
  std::int32_t active(Param param) { return ask(protocol::GetParameter{id(param)}).active; }
  static constexpr std::int32_t kOne_30 = 1 << 30;
};

TEST_F(Parameters, StagedValuesAreNotInForceUntilCommitted) {
  open_staging();
  stage(Param::b, 300'000'000);
  EXPECT_EQ(active(Param::b), 290'000'000);
  EXPECT_EQ(ask(protocol::GetParameter{id(Param::b)}).staged, 300'000'000);
  ask(protocol::CommitParameters{});
  EXPECT_EQ(active(Param::b), 300'000'000);
}

TEST_F(Parameters, CommittedValuesSurviveARestart) {
  open_staging();
  stage(Param::c_R, kOne_30 + 1000);
  ask(protocol::StageParameter{id(Param::robot_name), 0, Text<24>("Rosie")});
  ask(protocol::CommitParameters{});
  ask(protocol::Reboot{});
  silence_ms(100);
  EXPECT_EQ(client_.connect().robot_name.view(), "Rosie");
  EXPECT_EQ(active(Param::c_R), kOne_30 + 1000);
}

TEST_F(Parameters, AnInvalidSetNamesTheParameterAndChangesNothing) {
  open_staging();
  stage(Param::c_R, kOne_30 + 1000);
  stage(Param::b, 1);  // a nanometre
  const robot::RobotRefused refused = refusal(protocol::CommitParameters{});
  EXPECT_EQ(refused.code(), ErrorCode::invalid_parameter);
  EXPECT_EQ(refused.detail(), id(Param::b));
  EXPECT_EQ(active(Param::c_R), kOne_30);
}

TEST_F(Parameters, RevertDropsAndDefaultsStage) {
  open_staging();
  stage(Param::b, 300'000'000);
  ask(protocol::RevertParameters{});
  ask(protocol::CommitParameters{});
  EXPECT_EQ(active(Param::b), 290'000'000);
  stage(Param::b, 300'000'000);
  ask(protocol::CommitParameters{});
  ask(protocol::DefaultParameters{});
  EXPECT_EQ(active(Param::b), 300'000'000) << "staged, not in force";
  ask(protocol::CommitParameters{});
  EXPECT_EQ(active(Param::b), 290'000'000);
}

TEST_F(Parameters, ThePoseStaysWhereItIsAcrossACommit) {
  ask(protocol::Arm{});
  ask(robot::line(0.3).front());
  run_ms(3000);
  const Pose before = drive().pose();
  ask(protocol::Disarm{});
  open_staging();
  stage(Param::c_R, kOne_30 + 5'000'000);
  ask(protocol::CommitParameters{});
  silence_ms(10);
  EXPECT_EQ(drive().pose(), before);
}

TEST_F(Parameters, AppliedValuesAreInForceAndForgottenByARestart) {
  const std::int32_t kp = active(Param::kp);
  open_staging();
  stage(Param::kp, kp / 2);
  ask(protocol::ApplyParameters{});
  EXPECT_EQ(active(Param::kp), kp / 2);
  ask(protocol::Reboot{});
  silence_ms(100);
  client_.connect();
  EXPECT_EQ(active(Param::kp), kp);
}

TEST_F(Parameters, ACommitKeepsWhatItsSessionStagedAndNothingThatWasOnlyTried) {
  const std::int32_t kp = active(Param::kp);
  open_staging();
  stage(Param::kp, kp / 2);
  ask(protocol::ApplyParameters{});
  for (const bool anew : {true, false}) {
    if (anew) open_staging();
    stage(Param::b, 300'000'000);
    ask(protocol::CommitParameters{});
    EXPECT_EQ(active(Param::kp), kp / 2) << "it stays in force";
    EXPECT_EQ(active(Param::b), 300'000'000);
  }
  ask(protocol::Reboot{});
  silence_ms(100);
  client_.connect();
  EXPECT_EQ(active(Param::kp), kp) << "as it was said";
  EXPECT_EQ(active(Param::b), 300'000'000);
  open_staging();
  stage(Param::kp, kp / 2);
  ask(protocol::ApplyParameters{});
  open_staging();
  stage(Param::kp, kp / 2);  // the value in force, on purpose
  ask(protocol::CommitParameters{});
  ask(protocol::Reboot{});
  silence_ms(100);
  client_.connect();
  EXPECT_EQ(active(Param::kp), kp / 2);
}

TEST_F(Parameters, ACommitThatWouldNotFitWhatIsInTheFlashIsRefused) {
  // First a large over_speed is only tried. Then comes a speed limit that is valid only with it.
  open_staging();
  stage(Param::over_speed, 3'000'000);
  ask(protocol::ApplyParameters{});
  open_staging();
  stage(Param::speed_limit, 2'000'000);
  const robot::RobotRefused refused = refusal(protocol::CommitParameters{});
  EXPECT_EQ(refused.code(), ErrorCode::invalid_parameter);
  EXPECT_EQ(refused.detail(), id(Param::over_speed));
}

TEST_F(Parameters, GainsMayBeAppliedWhileDrivingAndTheRobotDoesNotFlinch) {
  ask(protocol::Arm{});
  for (int i = 0; i < 20; ++i) {
    ask(protocol::Velocity{300'000, 0});
    run_ms(100);
  }
  open_staging();
  stage(Param::kp, 30 << 16);
  stage(Param::kS_left, 0);
  stage(Param::kS_right, 0);
  ask(protocol::Velocity{300'000, 0});
  ask(protocol::ApplyParameters{});
  double worst_mps = 0;
  for (int ms = 0; ms < 150; ++ms) {
    silence_ms(1);
    worst_mps = std::max(worst_mps, std::abs(board().drivetrain().speed_radps()[0] * 0.036 - 0.3));
  }
  EXPECT_EQ(mode(), protocol::Mode::velocity);
  EXPECT_LT(worst_mps, 0.003) << "half a volt less at once would be 12 mm/s";
}

TEST_F(Parameters, WhatTheOdometryLivesByIsNotAppliedWhileDriving) {
  ask(protocol::Arm{});
  ask(protocol::Velocity{100'000, 0});
  open_staging();
  stage(Param::b, 300'000'000);
  EXPECT_EQ(refusal(protocol::ApplyParameters{}).code(), ErrorCode::moving);
  EXPECT_EQ(active(Param::b), 290'000'000);
}

TEST_F(Parameters, ATimeoutThatIsAppliedWhileDrivingIsRefusedAndOneAppliedAtRestHolds) {
  open_staging();
  stage(Param::command_timeout, 0);
  ask(protocol::ApplyParameters{});
  ask(protocol::Arm{});
  ask(protocol::Velocity{100'000, 0});
  stage(Param::command_timeout, 200);
  EXPECT_EQ(refusal(protocol::ApplyParameters{}).code(), ErrorCode::moving);
  ask(protocol::Rest{});
  run_ms(2000);
  ask(protocol::ApplyParameters{});
  ask(protocol::Velocity{100'000, 0});
  silence_ms(230);
  EXPECT_EQ(drive().faults().mask(), bit(Fault::command_timeout));
}

TEST_F(Parameters, ARobotThatRollsOnIsNotAtRest) {
  ask(protocol::Arm{});
  for (int i = 0; i < 15; ++i) {
    ask(protocol::Velocity{500'000, 0});
    run_ms(100);
  }
  ask(protocol::Disarm{});
  EXPECT_EQ(refusal(protocol::CommitParameters{}).code(), ErrorCode::moving);
  EXPECT_EQ(refusal(protocol::SetPose{}).code(), ErrorCode::moving);
  run_ms(4000);
  open_staging();
  ask(protocol::CommitParameters{});
}

TEST_F(Parameters, AFlashThatTakesNothingIsAFaultAndTheOldSetStays) {
  for (std::uint32_t sector = 0; sector < sim::Flash::kSectors; ++sector)
    board().flash().fail(sector, sim::FlashWork::program);
  open_staging();
  stage(Param::b, 300'000'000);
  EXPECT_EQ(refusal(protocol::CommitParameters{}).code(), ErrorCode::flash_failed);
  EXPECT_EQ(active(Param::b), 290'000'000);
  EXPECT_EQ(drive().faults().first(), Fault::flash);
  EXPECT_TRUE(open());
  EXPECT_EQ(refusal(protocol::Arm{}).code(), ErrorCode::faulted);
}

TEST_F(Parameters, OnlyWhoOpensTheStagingAreaChangesParameters) {
  EXPECT_EQ(refusal(protocol::StageParameter{id(Param::b), 300'000'000, {}}).code(), ErrorCode::staging_lost);
  EXPECT_EQ(refusal(protocol::CommitParameters{}).code(), ErrorCode::staging_lost);
  EXPECT_EQ(refusal(protocol::ApplyParameters{}).code(), ErrorCode::staging_lost);
  EXPECT_EQ(active(Param::b), 290'000'000);
}

TEST_F(Parameters, ASecondHostTakesTheStagingAreaAndTheFirstIsToldNothingIsMixed) {
  robot::Client other(std::make_unique<simulation::InProcessTransport>(robot_, 1));
  other.connect();
  open_staging();
  stage(Param::c_R, kOne_30 + 1000);
  stage(Param::b, 300'000'000);
  other.request(protocol::RevertParameters{});
  other.request(protocol::StageParameter{id(Param::c_L), kOne_30 - 1000, {}});
  EXPECT_EQ(refusal(protocol::StageParameter{id(Param::b), 310'000'000, {}}).code(), ErrorCode::staging_lost);
  EXPECT_EQ(refusal(protocol::CommitParameters{}).code(), ErrorCode::staging_lost);
  EXPECT_EQ(ask(protocol::GetParameter{id(Param::c_L)}).staged, kOne_30)
      << "what the other one stages is its own";
  EXPECT_EQ(other.request(protocol::GetParameter{id(Param::c_L)}).staged, kOne_30 - 1000);
  other.request(protocol::CommitParameters{});
  EXPECT_EQ(active(Param::c_L), kOne_30 - 1000);
  EXPECT_EQ(active(Param::c_R), kOne_30);
  EXPECT_EQ(active(Param::b), 290'000'000);
}

TEST_F(Parameters, ANewSessionCommitsNothingThatTheOneBeforeItStaged) {
  open_staging();
  stage(Param::b, 300'000'000);
  client_.connect();
  EXPECT_EQ(refusal(protocol::CommitParameters{}).code(), ErrorCode::staging_lost);
  EXPECT_EQ(ask(protocol::GetParameter{id(Param::b)}).staged, 290'000'000);
  open_staging();
  ask(protocol::CommitParameters{});
  EXPECT_EQ(active(Param::b), 290'000'000);
}

TEST_F(Parameters, AHelloAtTheOtherPortLeavesTheStagingAreaAlone) {
  open_staging();
  stage(Param::b, 300'000'000);
  robot::Client other(std::make_unique<simulation::InProcessTransport>(robot_, 1));
  other.connect();
  ask(protocol::CommitParameters{});
  EXPECT_EQ(active(Param::b), 300'000'000);
}

TEST_F(Parameters, UnknownIdsAndIndicesAreRefused) {
  EXPECT_EQ(refusal(protocol::GetParameter{9999}).code(), ErrorCode::unknown_parameter);
  EXPECT_EQ(refusal(protocol::StageParameter{0, 1, {}}).code(), ErrorCode::unknown_parameter);
  EXPECT_EQ(refusal(protocol::GetParameterInfo{9999}).code(), ErrorCode::unknown_parameter);
}

TEST_F(Parameters, TheTableDescribesItself) {
  const std::uint16_t count = client_.connect().parameter_count;
  ASSERT_EQ(count, kParamCount);
  for (std::uint16_t i = 0; i < count; ++i) {
    const protocol::ParameterInfo info = ask(protocol::GetParameterInfo{i});
    EXPECT_EQ(info.name.view(), kParamTable[i].name);
    EXPECT_EQ(info.doc.view(), kParamTable[i].doc);
    EXPECT_EQ(info.scale_exponent, kParamTable[i].exponent);
  }
}

}  // namespace
}  // namespace astro
