#include <gmock/gmock.h>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/programs/terminal_program.hpp"

// `astrolabe check-wiring` against simulators with wiring faults. The answers say what a person beside such a
// robot would have seen.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::Outcome;
using support::Simulator;
using testing::AllOf;
using testing::HasSubstr;
using Words = std::vector<std::string>;

Outcome check(const Simulator& simulator, const Words& more) {
  Words words{"check-wiring", "--port", simulator.port(), "--yes"};
  words.insert(words.end(), more.begin(), more.end());
  return astrolabe(words);
}

struct Case {
  std::string wiring, saw_left, saw_right, fault;
  bool by_parameters;
};

class Wired : public testing::TestWithParam<Case> {};

TEST_P(Wired, WronglyIsNamedAndTheRobotDrivesAfterTheUpload) {
  const Case& wrong = GetParam();
  const Simulator simulator({"--fast", "--slip", "0", "--true-ed", "1", "--wiring", wrong.wiring});
  const Outcome outcome =
      check(simulator, {"--saw-left", wrong.saw_left, "--saw-right", wrong.saw_right, "--upload", "--json"});
  EXPECT_EQ(outcome.code, wrong.by_parameters ? 0 : 1) << outcome.err;
  const json result = support::parse_json(outcome.out);
  ASSERT_EQ(result["findings"].size(), 1U) << outcome.out;
  EXPECT_EQ(result["findings"][0]["fault"], wrong.fault);
  EXPECT_EQ(result["needs_hands"], !wrong.by_parameters);
  if (!wrong.by_parameters) return;
  const Outcome drive = astrolabe({"drive", "line", "0.5", "--json", "--port", simulator.port()});
  ASSERT_EQ(drive.code, 0) << drive.err;
  EXPECT_NEAR(support::parse_json(drive.out)["moved"]["x_m"], 0.5, 0.003);
  EXPECT_NEAR(support::parse_json(drive.out)["moved"]["y_m"], 0, 0.003);
}

INSTANTIATE_TEST_SUITE_P(
    All, Wired,
    testing::Values(Case{"left-motor-reversed", "left-backward", "rf", "left_motor_reversed", true},
                    Case{"right-motor-reversed", "lf", "right-backward", "right_motor_reversed", true},
                    Case{"left-encoder-reversed", "lf", "rf", "left_encoder_reversed", true},
                    Case{"right-encoder-reversed", "lf", "rf", "right_encoder_reversed", true},
                    Case{"motors-swapped", "rf", "lf", "motors_swapped", false},
                    Case{"encoders-swapped", "lf", "rf", "encoders_swapped", false},
                    Case{"left-motor-dead", "none", "rf", "left_motor_dead", false},
                    Case{"right-encoder-dead", "lf", "rf", "right_encoder_dead", false},
                    Case{"left-channel-lost", "lf", "rf", "left_channel_missing", false}));

TEST(CheckWiring, ARightRobotIsToldSo) {
  const Simulator simulator({"--fast", "--on-stand"});
  const Outcome outcome = check(simulator, {"--saw-left", "lf", "--saw-right", "rf"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("wired as the parameters say"));
}

TEST(CheckWiring, WithoutEyesItLoadsNothingThatItWouldHaveToGuess) {
  const Simulator simulator({"--fast", "--on-stand", "--wiring", "left-encoder-reversed"});
  const Outcome outcome = check(simulator, {"--no-look", "--upload", "--json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--saw-left"));
  EXPECT_EQ(support::parse_json(outcome.out)["findings"][0]["fault"], "left_motor_or_encoder_reversed");
  EXPECT_EQ(support::parse_json(outcome.out)["parameters"], json::object());
}

TEST(CheckWiring, OffersAndLeavesAloneWithoutUpload) {
  const Simulator simulator({"--fast", "--on-stand", "--wiring", "left-motor-reversed"});
  const Outcome outcome = check(simulator, {"--saw-left", "lb", "--saw-right", "rf"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("motor_polarity_left"), HasSubstr("nothing was changed")));
  EXPECT_EQ(astrolabe({"params", "get", "motor_polarity_left", "--port", simulator.port()}).out, "1\n");
}

TEST(CheckWiring, AsksAtATerminalAndTurnsAgainOnRequest) {
  const Simulator simulator({"--fast", "--on-stand", "--wiring", "right-motor-reversed"});
  support::TerminalProgram program({ASTROLABE_PROGRAM, "check-wiring", "--port", simulator.port()});
  ASSERT_TRUE(program.shows("off the ground?"));
  program.type("y\n");
  ASSERT_TRUE(program.shows("Which wheel turned"));
  program.type("again\n");
  ASSERT_TRUE(program.shows("Which wheel turned"));
  program.type("perhaps\n");
  ASSERT_TRUE(program.shows("'perhaps' is none of these"));
  ASSERT_TRUE(program.shows("Which wheel turned"));
  program.type("lf\n");
  ASSERT_TRUE(program.shows("Which wheel turned"));
  program.type("rb\n");
  ASSERT_TRUE(program.shows("Load these"));
  program.type("y\n");
  EXPECT_EQ(program.wait(), 0) << program.seen();
  EXPECT_EQ(astrolabe({"params", "get", "motor_polarity_right", "--port", simulator.port()}).out, "-1\n");
}

TEST(CheckWiring, CtrlCAtAQuestionLeavesTheRobotDisarmed) {
  const Simulator simulator({"--fast", "--on-stand"});
  support::TerminalProgram program({ASTROLABE_PROGRAM, "check-wiring", "--port", simulator.port(), "--yes"});
  ASSERT_TRUE(program.shows("Which wheel turned"));
  program.send(SIGINT);
  EXPECT_EQ(program.wait(), 130) << program.seen();
  const json info = support::parse_json(astrolabe({"info", "--json", "--port", simulator.port()}).out);
  EXPECT_EQ(info["mode"], "disarmed");
  EXPECT_EQ(info["faults"], json::array());
}

TEST(CheckWiring, ARollThatNobodyMakesChangesNothing) {
  const Simulator simulator({"--fast", "--on-stand"});
  support::TerminalProgram program({ASTROLABE_PROGRAM, "check-wiring", "--port", simulator.port(), "--yes",
                                    "--saw-left", "lf", "--saw-right", "rf", "--roll"});
  ASSERT_TRUE(program.shows("How far was it?"));
  program.type("far\n");
  ASSERT_TRUE(program.shows("no length"));
  ASSERT_TRUE(program.shows("How far was it?"));
  program.type("2.26\n");
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.seen(), HasSubstr("counted next to nothing"));
}

}  // namespace
}  // namespace astro
