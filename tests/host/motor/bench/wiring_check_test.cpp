#include "host/motor/bench/wiring_check.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "host/base/interrupted.hpp"
#include "tests/host/motor/bench/rig.hpp"

namespace astro::motor {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using Next = WiringResult::Next;

constexpr double kMost_V = 4;
constexpr Sighting kLeftForward{Side::left, true}, kRightForward{Side::right, true};

/// A person who has seen this when the left and when the right motor was driven, and loads what is offered.
WiringHooks person(const Sighting& left, const Sighting& right) {
  WiringHooks hooks;
  hooks.look = [=](Side motor) { return Look{motor == Side::left ? left : right}; };
  hooks.load = [](const std::vector<robot::Change>&) { return true; };
  return hooks;
}

double in_force(support::Desk& desk, const std::string& parameter) {
  return robot::RemoteParameters::fetch(desk.client).number(parameter);
}

TEST(WiringCheck, ARobotThatIsRightIsInOrder) {
  support::Desk desk(quiet_robot(true));
  const WiringResult result = check_wires(desk.client, kMost_V, person(kLeftForward, kRightForward));
  EXPECT_THAT(result.wires.findings, IsEmpty());
  EXPECT_EQ(result.next(), Next::nothing);
}

TEST(WiringCheck, LoadsWhatCorrectsTheRobot) {
  sim::Config config = quiet_robot(true);
  config.wiring.left_motor_reversed = true;
  support::Desk desk(config);
  WiringHooks hooks = person({Side::left, false}, kRightForward);
  int uploaded = 0;
  hooks.uploaded = [&](const Remark&) { ++uploaded; };
  EXPECT_EQ(check_wires(desk.client, kMost_V, hooks).next(), Next::nothing);
  EXPECT_EQ(uploaded, 1);
  EXPECT_EQ(in_force(desk, "motor_polarity_left"), -1);
}

TEST(WiringCheck, OffersAndLeavesAloneWhatNobodyWantsLoaded) {
  sim::Config config = quiet_robot(true);
  config.wiring.left_motor_reversed = true;
  support::Desk desk(config);
  WiringHooks hooks = person({Side::left, false}, kRightForward);
  std::vector<robot::Change> offered;
  hooks.load = [&](const std::vector<robot::Change>& changes) {
    offered = changes;
    return false;
  };
  EXPECT_EQ(check_wires(desk.client, kMost_V, hooks).next(), Next::load_parameters);
  ASSERT_EQ(offered.size(), 1U);
  EXPECT_EQ(offered[0].name, "motor_polarity_left");
  EXPECT_EQ(in_force(desk, "motor_polarity_left"), 1);
}

TEST(WiringCheck, WithoutEyesItOffersNothingThatItWouldHaveToGuess) {
  sim::Config config = quiet_robot(true);
  config.wiring.left_encoder_reversed = true;
  support::Desk desk(config);
  WiringHooks hooks;
  hooks.load = [](const std::vector<robot::Change>&) {
    ADD_FAILURE() << "a guess was offered";
    return true;
  };
  const WiringResult result = check_wires(desk.client, kMost_V, hooks);
  ASSERT_EQ(result.wires.findings.size(), 1U);
  EXPECT_EQ(result.wires.findings[0].fault, "left_motor_or_encoder_reversed");
  EXPECT_EQ(result.next(), Next::look);
}

TEST(WiringCheck, ARobotWithSwappedMotorsIsNotRolled) {
  sim::Config config = quiet_robot(true);
  config.wiring.motors_swapped = true;
  support::Desk desk(config);
  WiringHooks hooks = person(kRightForward, kLeftForward);
  hooks.roll = [](const RobotFacts&, const std::function<void()>&) -> RolledLength {
    ADD_FAILURE() << "it was rolled";
    return {};
  };
  const WiringResult result = check_wires(desk.client, kMost_V, hooks);
  EXPECT_EQ(result.next(), Next::change_wires);
  EXPECT_FALSE(result.roll);
}

TEST(WiringCheck, DrivesAMotorOnceMoreIfItWasMissed) {
  support::Desk desk(quiet_robot(true));
  WiringHooks hooks = person(kLeftForward, kRightForward);
  std::vector<Side> driving;
  int driven = 0;
  bool missed = true;
  hooks.driving = [&](Side motor) { driving.push_back(motor); };
  hooks.driven = [&](const Probe&) { ++driven; };
  hooks.look = [&, look = hooks.look](Side motor) {
    return std::exchange(missed, false) ? Look{std::nullopt, true} : look(motor);
  };
  EXPECT_EQ(check_wires(desk.client, kMost_V, hooks).next(), Next::nothing);
  EXPECT_THAT(driving, ElementsAre(Side::left, Side::left, Side::right));
  EXPECT_EQ(driven, 2);
}

TEST(WiringCheck, NothingIsArmedWhileAQuestionIsOpen) {
  sim::Config config = quiet_robot(true);
  config.wiring.left_motor_reversed = true;
  support::Desk desk(config);
  WiringHooks hooks = person({Side::left, false}, kRightForward);
  int asked = 0;
  const auto expect_disarmed = [&] {
    ++asked;
    EXPECT_EQ(desk.client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
  };
  hooks.look = [&, look = hooks.look](Side motor) {
    expect_disarmed();
    return look(motor);
  };
  hooks.load = [&](const std::vector<robot::Change>&) {
    expect_disarmed();
    return true;
  };
  check_wires(desk.client, kMost_V, hooks);
  EXPECT_EQ(asked, 3);
}

TEST(WiringCheck, AnInterruptionStopsAndDisarms) {
  support::Desk desk(quiet_robot(true));
  WiringHooks hooks = person(kLeftForward, kRightForward);
  hooks.drive.interrupted = [&] { return desk.robot->board().drivetrain().speed_radps()[0] > 0.1; };
  EXPECT_THROW(check_wires(desk.client, kMost_V, hooks), Interrupted);
  EXPECT_EQ(desk.client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
  EXPECT_EQ(desk.client.request(protocol::GetStatus{}).latched_faults, 0U);
}

enum class Measure { metres, turns };

/// A robot that a person pushes for `way_m` once its wires are checked, and who measures how far it rolled.
WiringResult rolled(
    double counts_per_motor_rev, double way_m, Measure measure,
    const std::function<bool()>& interrupted = [] { return false; }) {
  sim::Config config = quiet_robot(false);
  config.counts_per_motor_rev = counts_per_motor_rev;
  support::Desk desk(config);
  auto& board = desk.robot->board();
  bool is_pushed = false;
  double pushed_m = 0;
  auto last = board.truth();
  const auto hand = desk.client.on<protocol::Telemetry>([&](const auto&) {
    const auto now = board.truth();
    if (is_pushed) pushed_m += std::hypot(now.x_m - last.x_m, now.y_m - last.y_m);
    last = now;
    const bool pushes = is_pushed && pushed_m < way_m && board.drivetrain().speed_radps()[0] < 8;
    for (const auto side : {Side::left, Side::right})
      board.set_load(side, {.torque_Nm = pushes ? 0.25 : 0.0});
  });
  WiringHooks hooks = person(kLeftForward, kRightForward);
  hooks.drive.interrupted = [&] { return is_pushed && interrupted(); };
  hooks.roll = [&](const RobotFacts& robot, const std::function<void()>& wait_until_rolled) {
    is_pushed = true;
    wait_until_rolled();
    return measure == Measure::metres
               ? RolledLength{.distance_m = pushed_m}
               : RolledLength{.turns = pushed_m / (std::numbers::pi * robot.wheel_diameter_m)};
  };
  const WiringResult result = check_wires(desk.client, kMost_V, hooks);
  if (!result.roll) return result;
  std::printf("%s\n", result.roll->finding.sentence.c_str());
  for (const auto& [name, value] : result.roll->parameters) EXPECT_NEAR(in_force(desk, name), value, 1e-6);
  return result;
}

TEST(WiringCheckRoll, WaitsUntilTheRobotHasBeenRolledAndLoadsTheCounts) {
  for (const double counts : {16.0, 32.0, 128.0})
    for (const Measure measure : {Measure::metres, Measure::turns})
      EXPECT_THAT(rolled(counts, 2.24, measure).roll.value().parameters,
                  ElementsAre(Pair("counts_per_motor_rev", counts)));
  const WiringResult right = rolled(64, 2.24, Measure::metres);
  EXPECT_TRUE(right.roll.value().agrees);
  EXPECT_EQ(right.next(), Next::nothing);
}

TEST(WiringCheckRoll, ARobotThatNobodyRollsIsGivenUp) { EXPECT_THROW(rolled(64, 0, Measure::turns), Error); }

TEST(WiringCheckRoll, AnInterruptionEndsTheWait) {
  EXPECT_THROW(rolled(64, 0, Measure::turns, [] { return true; }), Interrupted);
}

}  // namespace
}  // namespace astro::motor
