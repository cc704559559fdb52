#include "host/motor/bench/tune_motors.hpp"

#include <gmock/gmock.h>

#include "host/base/interrupted.hpp"
#include "tests/host/motor/bench/rig.hpp"

namespace astro::motor {
namespace {

using testing::ElementsAre;

protocol::Status status_of(support::Desk& desk) { return desk.client.request(protocol::GetStatus{}); }

double on_robot(support::Desk& desk, const std::string& parameter) {
  return robot::RemoteParameters::fetch(desk.client).number(parameter);
}

TEST(TuneMotors, OnTheGroundFindsEachMotorLoadsItAndMeasuresAgain) {
  sim::Config config = quiet_robot(false);
  config.motor_mismatch = 0.1;
  support::Desk desk(config);
  double most_progress = 0;
  int identified = 0, uploaded = 0;
  TuningHooks hooks;
  hooks.progress = [&](double part) { most_progress = std::max(most_progress, part); };
  hooks.identified = [&](const IdentifiedMotors&) {
    ++identified;
    EXPECT_EQ(status_of(desk).mode, protocol::Mode::disarmed) << "a caller may take its time";
  };
  hooks.uploaded = [&](const Remark&) { ++uploaded; };

  TuningResult result = tune_motors(desk.client, {}, hooks);
  EXPECT_EQ(identified, 1);
  EXPECT_GT(most_progress, 0.5) << "a small room makes it shorter than it could be";
  EXPECT_LT(most_progress, 1.1);
  for (const Side side : kSides) {
    const MotorModel truth = from_data_sheet(side == Side::left ? 0.95 : 1.05, false);
    EXPECT_NEAR(result.motors.wheels[at(side)].fit.model.kV, truth.kV, 0.01 * truth.kV);
    EXPECT_NEAR(result.motors.wheels[at(side)].fit.model.kA, truth.kA, 0.06 * truth.kA);
  }
  EXPECT_FALSE(result.uploaded);
  EXPECT_FALSE(result.verdict().was_measured);
  EXPECT_EQ(on_robot(desk, "kp"), result.before.kp) << "measuring changes no parameter";
  EXPECT_EQ(status_of(desk).mode, protocol::Mode::disarmed);

  load_and_measure_again(desk.client, result, hooks);
  EXPECT_EQ(uploaded, 1);
  EXPECT_TRUE(result.uploaded);
  EXPECT_TRUE(result.verdict().was_measured);
  for (const auto& [name, value] : result.proposed) EXPECT_NEAR(on_robot(desk, name), value, 1e-3) << name;
  for (const TunedStep& step : {result.step_before, result.step_after})
    for (const Side side : kSides) {
      const StepFigures measured = figures(step.measured[at(side)]);
      const StepFigures predicted = figures(step.predicted[at(side)]);
      EXPECT_NEAR(measured.rise_s, predicted.rise_s, 0.015);
      EXPECT_NEAR(measured.overshoot, predicted.overshoot, 0.01);
    }
  EXPECT_EQ(status_of(desk).mode, protocol::Mode::disarmed);
  EXPECT_EQ(status_of(desk).latched_faults, 0U);

  TuningResult again = tune_motors(desk.client, {}, hooks);
  load_and_measure_again(desk.client, again, hooks);
  EXPECT_EQ(again.verdict().change, StepVerdict::Change::same) << "the robot had these values already";
}

TEST(TuneMotors, RefusesABandwidthBeforeAnythingTurns) {
  support::Desk desk(quiet_robot(false));
  TuningHooks hooks;
  hooks.progress = [](double) { ADD_FAILURE() << "something turned"; };
  EXPECT_THROW(tune_motors(desk.client, {.bandwidth_radps = 314}, hooks), Error);
  EXPECT_EQ(desk.robot->board().truth().x_m, 0);
}

TEST(TuneMotors, StaysWithinTheRoomThatItIsGiven) {
  support::Desk desk(quiet_robot(false));
  double furthest_m = 0;
  const auto watching = desk.client.on<protocol::Telemetry>(
      [&](const auto&) { furthest_m = std::max(furthest_m, std::abs(desk.robot->board().truth().x_m)); });
  tune_motors(desk.client, {.distance_m = 0.8}, {});
  EXPECT_GT(furthest_m, 0.1);
  EXPECT_LE(furthest_m, 0.8);
}

TEST(TuneMotors, AnInterruptionStopsAndDisarms) {
  support::Desk desk(quiet_robot(true));
  bool interrupted = false;
  TuningHooks hooks;
  hooks.drive.interrupted = [&] { return interrupted; };
  hooks.progress = [&](double part) { interrupted = part > 0.1; };
  EXPECT_THROW(tune_motors(desk.client, {.on_stand = true}, hooks), Interrupted);
  EXPECT_EQ(status_of(desk).mode, protocol::Mode::disarmed);
  EXPECT_EQ(status_of(desk).latched_faults, 0U);
}

TEST(TuneMotors, LoadsNoPoorMeasurement) {
  support::Desk desk(quiet_robot(true));
  TuningResult result = tune_motors(desk.client, {.on_stand = true}, {});
  result.motors.wheels[1].fit.r_squared = 0.5;
  const double before = on_robot(desk, "kV_left");
  try {
    load_and_measure_again(desk.client, result, {});
    ADD_FAILURE() << "a poor measurement was loaded";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Kind(TuningProblem::poorly_measured));
    EXPECT_THAT(error.values(), ElementsAre("right"));
  }
  EXPECT_EQ(on_robot(desk, "kV_left"), before);
  EXPECT_FALSE(result.uploaded);
}

}  // namespace
}  // namespace astro::motor
