#include "host/commands/tune/check_wiring.hpp"

#include <gmock/gmock.h>

#include <cstdio>

#include "host/base/error.hpp"
#include "tests/support/robots/desk.hpp"

namespace astro::commands {
namespace {

using testing::ElementsAre;
using testing::Pair;

/// A robot that a person pushes for `way_m` along a tape measure, beginning when its telemetry runs.
motor::RollVerdict rolled(double counts_per_motor_rev, double way_m, WiringOptions options) {
  sim::Config config;
  config.counts_per_motor_rev = counts_per_motor_rev;
  support::Desk desk(config);
  auto& board = desk.robot->board();
  const auto hand = desk.client.on<protocol::Telemetry>([&](const auto&) {
    const bool pushes = board.truth().x_m < way_m && board.drivetrain().speed_radps()[0] < 8;
    for (const auto side : {Side::left, Side::right})
      board.set_load(side, {.torque_Nm = pushes ? 0.25 : 0.0});
  });
  const auto facts = motor::facts_of(robot::RemoteParameters::fetch(desk.client));
  options.roll = true;
  const auto verdict = roll(desk.client, facts, options);
  std::printf("%s\n", verdict.finding.sentence.c_str());
  return verdict;
}

TEST(WiringRoll, WaitsUntilTheRobotHasBeenRolledAndFindsTheCounts) {
  for (const double counts : {16.0, 32.0, 128.0}) {
    WiringOptions metres, turns;
    metres.rolled_distance_m = 2.26;
    turns.rolled_turns = 10;
    for (const auto& options : {metres, turns})
      EXPECT_THAT(rolled(counts, 2.24, options).parameters,
                  ElementsAre(Pair("counts_per_motor_rev", counts)));
  }
  WiringOptions right;
  right.rolled_distance_m = 2.26;
  EXPECT_TRUE(rolled(64, 2.24, right).agrees);
}

TEST(WiringRoll, ARobotThatNobodyRollsIsGivenUp) {
  WiringOptions options;
  options.rolled_turns = 10;
  EXPECT_THROW(rolled(64, 0, options), Error);
}

TEST(Sighting, WordsMeanWhatTheySay) {
  EXPECT_EQ(sighting_from("lb")->wheel, Side::left);
  EXPECT_FALSE(sighting_from("left-backward")->forward);
  EXPECT_EQ(sighting_from("rf")->wheel, Side::right);
  EXPECT_FALSE(sighting_from("none")->wheel);
  EXPECT_FALSE(sighting_from("LF"));
  EXPECT_FALSE(sighting_from(""));
}

}  // namespace
}  // namespace astro::commands
