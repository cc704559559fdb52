#include "host/motor/model/wiring.hpp"

#include <gmock/gmock.h>

namespace astro::motor {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::UnorderedElementsAre;

/// A robot with any combination of wrong wires and any polarities in its parameters.
struct Robot {
  bool motors_swapped = false, encoders_swapped = false;
  std::array<int, 2> motor{1, 1}, encoder{1, 1};  // orientation as built, by wheel
  std::array<bool, 2> motor_dead{}, encoder_dead{}, channel_missing{};
  Polarities set;

  Side motor_of(Side channel) const { return motors_swapped ? other(channel) : channel; }
  Side encoder_of(Side wheel) const { return encoders_swapped ? other(wheel) : wheel; }

  Probe probe(Side channel, bool looks = true) const {
    Probe probe{{}, 3, {}};
    const Side wheel = motor_of(channel), counter = encoder_of(wheel);
    const int turns = motor_dead[at(wheel)] ? 0 : set.motor[at(channel)] * motor[at(wheel)];
    if (looks) probe.seen = turns == 0 ? Sighting{} : Sighting{wheel, turns > 0};
    EncoderTrace& trace = probe.encoders[at(counter)];
    if (turns == 0 || encoder_dead[at(wheel)]) return probe;
    if (channel_missing[at(wheel)])
      trace = {1, 1, 350};
    else
      trace = {700 * turns * encoder[at(wheel)] * set.encoder[at(counter)], 700, 600};
    return probe;
  }
  WiringVerdict judged(bool looks = true) const {
    return judge_wiring({probe(Side::left, looks), probe(Side::right, looks)}, set);
  }
  /// As after following the verdict: wires in their places, parameters loaded.
  Robot repaired(const WiringVerdict& verdict) const {
    Robot robot = *this;
    robot.motors_swapped = robot.encoders_swapped = false;
    for (const Side side : kSides) {
      const auto take = [&](const std::string& name, int& into) {
        const auto found = verdict.parameters.find(name);
        if (found != verdict.parameters.end()) into = static_cast<int>(found->second);
      };
      take(std::string("motor_polarity_") + name(side), robot.set.motor[at(side)]);
      take(std::string("encoder_polarity_") + name(side), robot.set.encoder[at(side)]);
    }
    return robot;
  }
};

std::vector<std::string> faults(const WiringVerdict& verdict) {
  std::vector<std::string> words;
  for (const Finding& finding : verdict.findings) words.push_back(finding.fault);
  return words;
}

TEST(Wiring, ARobotThatIsRightHasNoFindings) {
  const WiringVerdict verdict = Robot{}.judged();
  EXPECT_THAT(verdict.findings, IsEmpty());
  EXPECT_THAT(verdict.parameters, IsEmpty());
  EXPECT_FALSE(verdict.needs_hands || verdict.needs_eyes);
}

TEST(Wiring, EachSingleFaultIsNamed) {
  Robot motor, encoder, dead, blind, half, swapped, crossed;
  motor.motor[0] = -1;
  encoder.encoder[1] = -1;
  dead.motor_dead[0] = true;
  blind.encoder_dead[1] = true;
  half.channel_missing[0] = true;
  swapped.motors_swapped = true;
  crossed.encoders_swapped = true;
  EXPECT_THAT(faults(motor.judged()), ElementsAre("left_motor_reversed"));
  EXPECT_THAT(motor.judged().parameters, ElementsAre(Pair("motor_polarity_left", -1)))
      << "the encoder, which counted backward with it, is right";
  EXPECT_THAT(faults(encoder.judged()), ElementsAre("right_encoder_reversed"));
  EXPECT_THAT(encoder.judged().parameters, ElementsAre(Pair("encoder_polarity_right", -1)));
  EXPECT_THAT(faults(dead.judged()), ElementsAre("left_motor_dead"));
  EXPECT_THAT(faults(blind.judged()), ElementsAre("right_encoder_dead"));
  EXPECT_THAT(faults(half.judged()), ElementsAre("left_channel_missing"));
  EXPECT_THAT(faults(swapped.judged()), ElementsAre("motors_swapped"));
  EXPECT_THAT(faults(crossed.judged()), ElementsAre("encoders_swapped"));
  for (const Robot& robot : {dead, blind, half, swapped, crossed}) {
    EXPECT_TRUE(robot.judged().needs_hands);
    EXPECT_THAT(robot.judged().parameters, IsEmpty());
  }
}

// All 64 ways to swap and reverse, under all 16 settings of the parameters.
TEST(Wiring, EveryCombinationOfSwapsAndReversalsIsRepaired) {
  for (int build = 0; build < 64; ++build) {
    for (int setting = 0; setting < 16; ++setting) {
      const auto sign = [](int bits, int bit) { return (bits >> bit & 1) != 0 ? -1 : 1; };
      Robot robot;
      robot.motors_swapped = (build & 1) != 0;
      robot.encoders_swapped = (build & 2) != 0;
      robot.motor = {sign(build, 2), sign(build, 3)};
      robot.encoder = {sign(build, 4), sign(build, 5)};
      robot.set = {{sign(setting, 0), sign(setting, 1)}, {sign(setting, 2), sign(setting, 3)}};
      const WiringVerdict verdict = robot.judged();
      EXPECT_EQ(verdict.needs_hands, robot.motors_swapped || robot.encoders_swapped);
      const WiringVerdict after = robot.repaired(verdict).judged();
      EXPECT_THAT(after.findings, IsEmpty()) << "build " << build << " setting " << setting;
      EXPECT_THAT(after.parameters, IsEmpty()) << "build " << build << " setting " << setting;
    }
  }
}

TEST(Wiring, ReversalsThatCancelAreSeenOnlyByEye) {
  Robot robot;
  robot.motor[0] = robot.encoder[0] = -1;
  EXPECT_THAT(robot.judged(false).findings, IsEmpty());
  EXPECT_TRUE(robot.judged(false).needs_eyes);
  EXPECT_THAT(robot.judged().parameters,
              UnorderedElementsAre(Pair("motor_polarity_left", -1), Pair("encoder_polarity_left", -1)));
}

TEST(Wiring, WithoutEyesItSaysWhatItCannotTell) {
  Robot reversed, swapped, dead;
  reversed.encoder[0] = -1;
  swapped.motors_swapped = true;
  dead.encoder_dead[1] = true;
  EXPECT_THAT(faults(reversed.judged(false)), ElementsAre("left_motor_or_encoder_reversed"));
  EXPECT_THAT(faults(swapped.judged(false)), ElementsAre("motors_or_encoders_swapped"));
  EXPECT_THAT(faults(dead.judged(false)), ElementsAre("right_motor_or_encoder_dead"));
  for (const Robot& robot : {reversed, swapped, dead}) EXPECT_THAT(robot.judged(false).parameters, IsEmpty());
}

TEST(Wiring, TwoOutputsOnOneWheelAndSightingsAgainstTheCountsAreSaid) {
  Robot robot;
  auto probes = std::array{robot.probe(Side::left), robot.probe(Side::right)};
  probes[1].seen = Sighting{Side::left, true};
  EXPECT_THAT(faults(judge_wiring(probes, {})), ElementsAre("one_wheel"));
  probes[1].seen = Sighting{};
  EXPECT_THAT(faults(judge_wiring(probes, {})), ElementsAre("contradiction"));
}

TEST(Motion, ToggleIsNeitherStandingNorTurning) {
  EXPECT_EQ(motion_of({0, 0, 0}), Motion::none);
  EXPECT_EQ(motion_of({2, 2, 3}), Motion::none) << "a hand that touched it";
  EXPECT_EQ(motion_of({1, 1, 200}), Motion::toggles);
  EXPECT_EQ(motion_of({100, 100, 90}), Motion::forward);
  EXPECT_EQ(motion_of({-100, 100, 90}), Motion::backward);
}

}  // namespace
}  // namespace astro::motor
