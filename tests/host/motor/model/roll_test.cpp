#include "host/motor/model/roll.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/support/base/remarks.hpp"

namespace astro::motor {
namespace {

using support::Tells;
using support::ThrowsTelling;
using testing::ElementsAre;
using testing::Pair;

/// Ten turns of ASTRO as its parameters have it, while it really counts `factor` times that.
Roll ten_turns(double factor) {
  Roll roll{{10 * 2803.2 * factor, -10 * 2803.2 * factor}, 64, 43.8, 0.072, {}, {}};
  roll.turns = 10;
  return roll;
}
Roll along_the_tape(double factor) {
  Roll roll = ten_turns(factor);
  roll.turns.reset();
  roll.distance_m = 10 * std::numbers::pi * 0.072;
  return roll;
}

TEST(Roll, AnotherDecodingIsAPowerOfTwo) {
  for (const double factor : {0.25, 0.5, 2.0, 4.0, 8.0}) {
    for (const Roll& roll : {ten_turns(1.02 * factor), along_the_tape(0.98 * factor)}) {
      const RollVerdict verdict = judge_roll(roll);
      EXPECT_FALSE(verdict.agrees);
      EXPECT_THAT(verdict.parameters, ElementsAre(Pair("counts_per_motor_rev", 64 * factor)));
      EXPECT_THAT(verdict.finding, Tells(RollProblem::other_decoding));
    }
  }
}

TEST(Roll, WhatATapeCannotTellChangesNothing) {
  for (const double factor : {0.98, 1.0, 1.025}) {
    EXPECT_TRUE(judge_roll(along_the_tape(factor)).agrees);
    EXPECT_TRUE(judge_roll(along_the_tape(factor)).parameters.empty());
  }
}

TEST(Roll, AnotherRatioIsAnotherGearIfTurnsWereCounted) {
  const RollVerdict verdict = judge_roll(ten_turns(30.0 / 43.8));
  EXPECT_THAT(verdict.parameters,
              ElementsAre(Pair("gear_denominator", 1000), Pair("gear_numerator", 30'000)));
  EXPECT_THAT(verdict.finding, Tells(RollProblem::other_gear, "30.000", "43.800"));
}

TEST(Roll, AnotherRatioAlongATapeIsAnotherDiameter) {
  const RollVerdict verdict = judge_roll(along_the_tape(0.9));
  ASSERT_EQ(verdict.parameters.size(), 1U);
  EXPECT_NEAR(verdict.parameters.at("wheel_diameter"), 0.080, 1e-9);
}

TEST(Roll, WheelsThatDisagreeChangeNothing) {
  Roll roll = ten_turns(1);
  roll.counts[0] /= 4;
  const RollVerdict verdict = judge_roll(roll);
  EXPECT_FALSE(verdict.agrees);
  EXPECT_TRUE(verdict.parameters.empty());
  EXPECT_THAT(verdict.finding, Tells(RollProblem::wheels_differ, "0.25", "1"));
}

TEST(Roll, ATenfoldTypoInTheLengthIsNotTakenForAnotherWheel) {
  for (const double typo : {0.1, 10.0}) {
    Roll roll = along_the_tape(1);
    *roll.distance_m *= typo;
    EXPECT_THAT([&] { judge_roll(roll); }, ThrowsTelling(RollProblem::unlikely_length));
    roll = ten_turns(1);
    *roll.turns *= typo;
    EXPECT_THAT([&] { judge_roll(roll); }, ThrowsTelling(RollProblem::unlikely_length));
  }
}

TEST(Roll, AWheelThatDidNotTurnIsNamed) {
  Roll roll = ten_turns(1);
  roll.counts[1] = 3;
  EXPECT_THAT([&] { judge_roll(roll); }, ThrowsTelling(RollProblem::counts_nothing, "right"));
  roll.turns = 0.1;
  EXPECT_THAT([&] { judge_roll(roll); }, ThrowsTelling(RollProblem::too_short));
}

}  // namespace
}  // namespace astro::motor
