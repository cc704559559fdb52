#include "host/motor/bench/identify.hpp"

#include <gmock/gmock.h>

#include <cstdio>

#include "host/base/error.hpp"
#include "tests/host/motor/bench/rig.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::motor {
namespace {

using support::Tells;

struct Measured {
  IdentifiedMotors identity;
  double furthest_m = 0;  // from the start, in truth
  double end_m = 0;
};

Measured measure(const sim::Config& config, const Bounds& bounds) {
  support::Desk desk(config);
  Bench bench(desk.client, facts_on(desk));
  robot::DriveSession session(desk.client);
  Measured measured;
  measured.identity = identify(bench, session, bounds, [&](double) {
    measured.furthest_m = std::max(measured.furthest_m, std::abs(desk.robot->board().truth().x_m));
  });
  measured.end_m = std::abs(desk.robot->board().truth().x_m);
  return measured;
}

void expect_found(const IdentifiedMotors& identity, double mismatch, bool on_stand, double part) {
  for (const Side side : kSides) {
    const MotorModel truth = from_data_sheet(1 + (side == Side::left ? -0.5 : 0.5) * mismatch, on_stand);
    const auto& [fit, forward_V, backward_V] = identity.wheels[at(side)];
    std::printf(
        "%5s  kS %.4f +- %.4f (%+.1f %%)  kV %.3f +- %.3f (%+.2f %%)  kA %.4f +- %.4f (%+.1f %%)  "
        "breakaway %.2f / %.2f V  residual %.3f V  %zu windows  %.0f s\n",
        name(side), fit.model.kS, fit.standard_error.kS, 100 * (fit.model.kS / truth.kS - 1), fit.model.kV,
        fit.standard_error.kV, 100 * (fit.model.kV / truth.kV - 1), fit.model.kA, fit.standard_error.kA,
        100 * (fit.model.kA / truth.kA - 1), forward_V.value_or(0), backward_V.value_or(0), fit.residual_V,
        fit.windows.size(), identity.seconds);
    EXPECT_NEAR(fit.model.kS, truth.kS, part * truth.kS);
    EXPECT_NEAR(fit.model.kV, truth.kV, 0.01 * truth.kV);
    EXPECT_NEAR(fit.model.kA, truth.kA, part * truth.kA);
    EXPECT_GT(fit.r_squared, 0.99);
  }
}

TEST(Identify, OnAStandFindsTheDataSheet) {
  const Measured measured = measure(quiet_robot(true), {});
  expect_found(measured.identity, 0, true, 0.03);
  for (const auto& wheel : measured.identity.wheels) {
    EXPECT_NEAR(wheel.breakaway_forward_V.value(), 1.0, 0.04) << "starting voltage of the data sheet";
    EXPECT_NEAR(wheel.breakaway_backward_V.value(), 1.0, 0.04);
  }
}

TEST(Identify, OnTheGroundFindsTheDataSheetAndTheRobotsMassWithinItsRoom) {
  for (const double room_m : {0.6, 1.0, 2.0}) {
    std::printf("within %.1f m\n", room_m);
    const Measured measured = measure(quiet_robot(false), {5, room_m});
    expect_found(measured.identity, 0, false, 0.04);
    EXPECT_LT(measured.furthest_m, room_m);
    EXPECT_LT(measured.end_m, 0.35 * room_m) << "it comes back";
  }
}

TEST(Identify, AMotorThatIsTenPercentStrongerIsFoundWheelByWheel) {
  for (const bool on_stand : {true, false}) {
    sim::Config config = quiet_robot(on_stand);
    config.motor_mismatch = 0.1;
    const Measured measured = measure(config, {5, on_stand ? 1e9 : 1.0});
    // On the ground the wheels differ in speed too, so each feels some of the other's inertia.
    expect_found(measured.identity, 0.1, on_stand, on_stand ? 0.03 : 0.05);
    const auto& wheels = measured.identity.wheels;
    EXPECT_NEAR(wheels[1].fit.model.kV / wheels[0].fit.model.kV, 1.1, 0.015);
  }
}

Remark refusal(const sim::Config& config, const Bounds& bounds) {
  support::Desk desk(config);
  const Remark told = support::told_by([&] {
    Bench bench(desk.client, facts_on(desk));
    robot::DriveSession session(desk.client);
    identify(bench, session, bounds, [](double) {});
  });
  const protocol::Status status = desk.client.request(protocol::GetStatus{});
  EXPECT_EQ(status.mode, protocol::Mode::disarmed);
  EXPECT_EQ(status.latched_faults, 0U) << "stopped before the firmware has to";
  std::printf("%s\n", told.sentence.c_str());
  return told;
}

TEST(Identify, AWheelThatDoesNotAnswerIsNamedAndNothingIsLatched) {
  sim::Config dead = quiet_robot(true), blind = dead, reversed = dead;
  dead.wiring.left_motor_dead = true;
  blind.wiring.right_encoder_dead = true;
  reversed.wiring.right_encoder_reversed = true;
  EXPECT_THAT(refusal(dead, {}), Tells(BenchProblem::stands, "left"));
  EXPECT_THAT(refusal(blind, {}), Tells(BenchProblem::stands, "right"));
  EXPECT_THAT(refusal(reversed, {}), Tells(BenchProblem::counts_backward, "right"));
}

TEST(Identify, TooLittleRoomOrVoltageIsSaid) {
  EXPECT_THAT(refusal(quiet_robot(false), {5, 0.02}), Tells(BenchProblem::out_of_room, testing::_, "0.02"));
  EXPECT_THAT(refusal(quiet_robot(true), {1.2}), Tells(BenchProblem::stands_at_little_voltage));
}

TEST(Identify, AnInterruptLeavesTheRobotStoppedAndDisarmed) {
  support::Desk desk(quiet_robot(true));
  bool stop = false;
  {
    Bench bench(desk.client, facts_on(desk));
    robot::DriveHooks hooks;
    hooks.interrupted = [&] { return stop; };
    robot::DriveSession session(desk.client, hooks);
    EXPECT_THROW(identify(bench, session, {}, [&](double part) { stop = part > 0.2; }), Interrupted);
  }
  EXPECT_EQ(desk.client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
  for (int ms = 0; ms < 500; ++ms) desk.robot->step();
  EXPECT_EQ(desk.robot->board().drivetrain().speed_radps()[0], 0.0);
}

}  // namespace
}  // namespace astro::motor
