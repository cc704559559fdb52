#include "host/motor/bench/tuning.hpp"

#include <gmock/gmock.h>

#include "host/motor/bench/tuning_steps.hpp"

namespace astro::motor {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::Key;
using testing::Pair;

/// ASTRO's motors, measured well.
IdentifiedMotors motors() {
  IdentifiedMotors found;
  for (IdentifiedMotor& wheel : found.wheels) {
    wheel.fit.model = {0.480049, 12.34567, 1.98765};
    wheel.fit.standard_error = {0.01, 0.05, 0.05};
    wheel.fit.r_squared = 0.999;
  }
  return found;
}

RobotFacts robot() {
  RobotFacts facts;
  facts.count_m = {8e-5, 8e-5};
  facts.feed_forward = {MotorModel{0.5, 12, 2}, MotorModel{0.5, 12, 2}};
  facts.kp = 5;
  facts.ki = 20;
  facts.observer_radps = 200;
  facts.speed_limit_mps = 1;
  facts.acceleration_limit_mps2 = 1;
  return facts;
}

TEST(Tuning, ProposesFeedForwardAndGainsToFourDigits) {
  const GainDesign gains = design_for(motors(), robot(), 0);
  const ControlParameters proposed = proposed_parameters(motors(), gains.design, false);
  EXPECT_EQ(proposed.size(), 8U);
  EXPECT_THAT(proposed, Contains(Pair("kS_left", DoubleNear(0.48, 1e-12))));
  EXPECT_THAT(proposed, Contains(Pair("kV_right", DoubleNear(12.35, 1e-12))));
  EXPECT_NEAR(proposed.at("kp"), gains.design.kp, 5e-4 * gains.design.kp);
  const RobotFacts tuned = with_parameters(robot(), proposed);
  EXPECT_EQ(tuned.kp, proposed.at("kp"));
  EXPECT_EQ(tuned.feed_forward[1].kA, proposed.at("kA_right"));
}

TEST(Tuning, OffTheGroundProposesWhatNeedsNoMass) {
  EXPECT_THAT(proposed_parameters(motors(), {}, true),
              ElementsAre(Key("kS_left"), Key("kS_right"), Key("kV_left"), Key("kV_right")));
}

TEST(Tuning, NamesTheWheelThatWasMeasuredTooPoorly) {
  EXPECT_EQ(poorly_measured(motors()), std::nullopt);
  IdentifiedMotors noisy = motors(), short_drive = motors();
  noisy.wheels[0].fit.r_squared = 0.97;
  short_drive.wheels[1].fit.standard_error.kA = 0.25 * short_drive.wheels[1].fit.model.kA;
  EXPECT_EQ(poorly_measured(noisy), Side::left);
  EXPECT_EQ(poorly_measured(short_drive), Side::right);
}

TEST(Tuning, NoticesMotorsOfAnotherRobot) {
  EXPECT_EQ(unlikely_kV_ratio({0.5, 13, 2}, robot()), std::nullopt);
  EXPECT_EQ(unlikely_kV_ratio({0.5, 24, 2}, robot()), 2);
  RobotFacts new_robot = robot();
  new_robot.feed_forward = {};
  EXPECT_EQ(unlikely_kV_ratio({0.5, 24, 2}, new_robot), std::nullopt) << "nothing to compare with";
}

TEST(Tuning, RefusesABandwidthFarBeyondTheObserverBeforeAnythingTurns) {
  EXPECT_NO_THROW(require_possible_bandwidth(robot(), 20));
  EXPECT_THROW(require_possible_bandwidth(robot(), 2000), Error);
}

TEST(Tuning, PlansAStepWithinVoltageSpeedAndRoom) {
  const MotorModel mean = mean_model(motors());
  EXPECT_DOUBLE_EQ(plan_step(mean, robot(), {24, 100}).speed_mps, 0.4) << "of the speed limit";
  EXPECT_LT(plan_step(mean, robot(), {3, 100}).speed_mps, 0.8 * 3 / mean.kV);
  const StepPlan small_room = plan_step(mean, robot(), {24, 0.3});
  EXPECT_LE(small_room.speed_mps * small_room.hold_s, 0.6 * 0.3);
}

StepCourses course(double error_mps) {
  const StepCourse one{{0, 0.001}, {0.2, 0.2}, {0.2 - error_mps, 0.2 - error_mps}};
  return {one, one};
}

TEST(Tuning, JudgesAStepByMoreThanARepetitionDiffers) {
  using Change = StepVerdict::Change;
  const StepCourses before = course(0.02), predicted = course(0.01);
  for (const auto& [error_mps, change] :
       {std::pair{0.01, Change::better}, std::pair{0.019, Change::same}, std::pair{0.03, Change::worse}}) {
    const StepCourses now = course(error_mps);
    EXPECT_EQ(judge_step(before, predicted, &now).change, change) << error_mps;
  }
  const StepVerdict only_predicted = judge_step(before, predicted, nullptr);
  EXPECT_FALSE(only_predicted.was_measured);
  EXPECT_EQ(only_predicted.now_mps, only_predicted.predicted_mps);
  const StepCourses slipping = course(0.025);
  EXPECT_TRUE(judge_step(before, predicted, &slipping).unexplained);
}

}  // namespace
}  // namespace astro::motor
