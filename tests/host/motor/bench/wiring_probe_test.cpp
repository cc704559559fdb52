#include "host/motor/bench/wiring_probe.hpp"

#include <gmock/gmock.h>

#include <cstdio>

#include "host/robot/motion/paths.hpp"
#include "tests/host/motor/bench/rig.hpp"

namespace astro::motor {
namespace {

using motor::judge_wiring;
using motor::Sighting;
using motor::WiringVerdict;
using testing::ElementsAre;

/// Who watches the wheels of the simulated robot.
class Eyes {
 public:
  explicit Eyes(support::Desk& desk) : desk_(desk) {}
  void look() {
    const auto speed = desk_.robot->board().drivetrain().speed_radps();
    for (std::size_t side = 0; side < 2; ++side)
      if (std::abs(speed[side]) > std::abs(fastest_[side])) fastest_[side] = speed[side];
  }
  Sighting sighting() {
    const Side wheel = std::abs(fastest_[0]) > std::abs(fastest_[1]) ? Side::left : Side::right;
    const double speed = fastest_[at(wheel)];
    fastest_ = {};
    return std::abs(speed) < 0.1 ? Sighting{} : Sighting{wheel, speed > 0};
  }

 private:
  support::Desk& desk_;
  sim::Pair fastest_{};
};

WiringVerdict check(support::Desk& desk) {
  const RobotFacts facts = facts_on(desk);
  Bench bench(desk.client, facts);
  robot::DriveSession session(desk.client);
  Eyes eyes(desk);
  const auto watching = desk.client.on<protocol::Telemetry>([&](const auto&) { eyes.look(); });
  std::array<motor::Probe, 2> probes;
  for (const Side motor : kSides) {
    probes[at(motor)] = probe_motor(bench, session, motor, 4);
    probes[at(motor)].seen = eyes.sighting();
  }
  return judge_wiring(probes, facts.polarities);
}

struct Case {
  const char* fault;
  bool sim::Wiring::*flag;
  bool by_parameters;  // can be corrected without a screwdriver
};

class SingleFault : public testing::TestWithParam<Case> {};

TEST_P(SingleFault, IsNamedAndWhatIsOfferedMakesTheRobotDriveStraight) {
  sim::Config config = quiet_robot(true);
  config.wiring.*GetParam().flag = true;
  support::Desk desk(config);
  const WiringVerdict verdict = check(desk);
  ASSERT_EQ(verdict.findings.size(), 1U);
  std::printf("%s\n", verdict.findings[0].remark.sentence.c_str());
  EXPECT_EQ(verdict.findings[0].fault, GetParam().fault);
  EXPECT_EQ(verdict.needs_hands, !GetParam().by_parameters);
  EXPECT_EQ(verdict.parameters.size(), GetParam().by_parameters ? 1U : 0U);
  EXPECT_EQ(desk.client.request(protocol::GetStatus{}).latched_faults, 0U);
  if (!GetParam().by_parameters) return;

  config.on_stand = false;
  support::Desk floor(config);
  for (const auto& [name, value] : verdict.parameters) set(floor, {{name, value}});
  robot::DriveSession session(floor.client);
  session.run(robot::line(0.5));
  const auto truth = floor.robot->board().truth();
  EXPECT_NEAR(truth.x_m, 0.5, 0.003);
  EXPECT_NEAR(truth.y_m, 0, 0.003);
}

INSTANTIATE_TEST_SUITE_P(
    All, SingleFault,
    testing::Values(Case{"left_motor_reversed", &sim::Wiring::left_motor_reversed, true},
                    Case{"right_motor_reversed", &sim::Wiring::right_motor_reversed, true},
                    Case{"left_encoder_reversed", &sim::Wiring::left_encoder_reversed, true},
                    Case{"right_encoder_reversed", &sim::Wiring::right_encoder_reversed, true},
                    Case{"motors_swapped", &sim::Wiring::motors_swapped, false},
                    Case{"encoders_swapped", &sim::Wiring::encoders_swapped, false},
                    Case{"left_motor_dead", &sim::Wiring::left_motor_dead, false},
                    Case{"right_motor_dead", &sim::Wiring::right_motor_dead, false},
                    Case{"left_encoder_dead", &sim::Wiring::left_encoder_dead, false},
                    Case{"right_encoder_dead", &sim::Wiring::right_encoder_dead, false},
                    Case{"left_channel_missing", &sim::Wiring::left_channel_lost, false},
                    Case{"right_channel_missing", &sim::Wiring::right_channel_lost, false}),
    [](const auto& param_info) { return std::string(param_info.param.fault); });

std::vector<std::string> faults(const WiringVerdict& verdict) {
  std::vector<std::string> words;
  for (const auto& finding : verdict.findings) words.push_back(finding.fault);
  return words;
}

TEST(Wiring, MotorsAndEncodersBothSwappedAreSeenThoughTheCountsAgree) {
  sim::Config config = quiet_robot(true);
  config.wiring.motors_swapped = config.wiring.encoders_swapped = true;
  support::Desk desk(config);
  EXPECT_THAT(faults(check(desk)), ElementsAre("motors_swapped", "encoders_swapped"));
}

TEST(Wiring, AChannelThatBreaksAndALeadThatComesOffWhileItRunsAreNamed) {
  support::Desk desk(quiet_robot(true));
  desk.robot->board().encoders().lose_channel(Side::right);
  desk.robot->board().motors().disconnect(Side::left);
  EXPECT_THAT(faults(check(desk)), ElementsAre("left_motor_dead", "right_channel_missing"));
}

TEST(Wiring, OnTheGroundTheOtherWheelMayBeDraggedAlong) {
  sim::Config config = quiet_robot(false);
  config.wiring.right_encoder_reversed = true;
  support::Desk desk(config);
  EXPECT_THAT(faults(check(desk)), ElementsAre("right_encoder_reversed"));
}

TEST(Wiring, WrongCountsPerRevolutionDoNotMatterHere) {
  for (const double counts : {16.0, 32.0, 128.0}) {
    sim::Config config = quiet_robot(true);
    config.counts_per_motor_rev = counts;
    config.wiring.left_motor_reversed = true;
    support::Desk desk(config);
    EXPECT_THAT(faults(check(desk)), ElementsAre("left_motor_reversed"));
  }
}

}  // namespace
}  // namespace astro::motor
