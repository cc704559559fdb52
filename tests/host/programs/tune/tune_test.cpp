#include <gmock/gmock.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/programs/terminal_program.hpp"

// `astrolabe tune` against a simulator in fast motion.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::Outcome;
using support::Simulator;
using testing::AllOf;
using testing::HasSubstr;
using Words = std::vector<std::string>;

// What the motors' data sheet leads to at the wheel; tests/host/motor/bench/identify_test.cpp derives it.
constexpr double kS_V = 0.48, kV_Vspm = 12.175, kA_ground = 1.077, kA_stand = 0.5235;

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string report_in(const Simulator& simulator) { return (simulator.folder() / "tune.html").string(); }

Outcome tune(const Simulator& simulator, const Words& more) {
  return astrolabe(with({"tune", "--port", simulator.port(), "--out", report_in(simulator)}, more));
}

json info(const Simulator& simulator) {
  return support::parse_json(astrolabe({"info", "--json", "--port", simulator.port()}).out);
}

double on_robot(const Simulator& simulator, const std::string& name) {
  return support::parse_json(
      astrolabe({"params", "get", name, "--json", "--port", simulator.port()}).out)["value"];
}

std::string content(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_model(const json& wheel, double strength, double kA) {
  const auto value = [&](const char* name) { return wheel[name]["value"].get<double>(); };
  EXPECT_NEAR(value("kS"), kS_V / strength, 0.04 * kS_V);
  EXPECT_NEAR(value("kV"), kV_Vspm * strength, 0.01 * kV_Vspm);
  EXPECT_NEAR(value("kA"), kA / strength, 0.06 * kA);
}

TEST(Tune, OnTheGroundFindsEachMotorLoadsItAndMeasuresAgain) {
  const Simulator simulator({"--fast", "--motor-mismatch", "0.1"});
  const Outcome outcome = tune(simulator, {"--on-ground", "--yes", "--upload", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json result = support::parse_json(outcome.out);
  expect_model(result["wheels"]["left"], 0.95, kA_ground);
  expect_model(result["wheels"]["right"], 1.05, kA_ground);
  EXPECT_TRUE(result["uploaded"]);
  EXPECT_GT(result["designed"]["margins"]["phase_margin_rad"], 1.04);
  for (const char* name : {"kp", "ki"})
    EXPECT_NEAR(on_robot(simulator, name), result["designed"][name].get<double>(), 0.1) << name;
  EXPECT_NEAR(on_robot(simulator, "kV_right"), result["wheels"]["right"]["kV"]["value"].get<double>(), 0.01);
  ASSERT_EQ(result["steps"].size(), 3U);
  EXPECT_EQ(result["steps"][1]["title"], "after");
  EXPECT_LT(result["steps"][2]["left"]["predicted"]["rise_s"], 0.1) << "the loop alone, without limits";
  for (const json& step : {result["steps"][0], result["steps"][1]}) {
    for (const char* side : {"left", "right"}) {
      const json& measured = step[side]["measured"];
      const json& predicted = step[side]["predicted"];
      std::printf(
          "%s, %s: rise %.0f ms (predicted %.0f), overshoot %.2f %% (%.2f), rms error %.2f mm/s (%.2f)\n",
          step["title"].get<std::string>().c_str(), side, 1e3 * measured["rise_s"].get<double>(),
          1e3 * predicted["rise_s"].get<double>(), 100 * measured["overshoot"].get<double>(),
          100 * predicted["overshoot"].get<double>(), 1e3 * measured["rms_error_mps"].get<double>(),
          1e3 * predicted["rms_error_mps"].get<double>());
      EXPECT_NEAR(measured["rise_s"], predicted["rise_s"].get<double>(), 0.015);
      EXPECT_NEAR(measured["overshoot"], predicted["overshoot"].get<double>(), 0.01);
    }
  }
  EXPECT_EQ(info(simulator)["mode"], "disarmed");
  EXPECT_EQ(info(simulator)["faults"], json::array());
  EXPECT_THAT(content(report_in(simulator)),
              AllOf(HasSubstr("data-figure=\"motor\""), HasSubstr("After, right")));
}

TEST(Tune, OnAStandOffersFrictionAndGainOnlyAndLoadsNothingUnasked) {
  const Simulator simulator({"--fast", "--on-stand"});
  const Outcome outcome = tune(simulator, {"--on-stand", "--yes", "--json", "--bandwidth", "40rad/s"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json result = support::parse_json(outcome.out);
  expect_model(result["wheels"]["left"], 1, kA_stand);
  EXPECT_NEAR(result["designed"]["margins"]["bandwidth_radps"], 40, 0.5);
  for (const json& change : result["changes"])
    EXPECT_THAT(change["name"].get<std::string>(), testing::AnyOf(HasSubstr("kS_"), HasSubstr("kV_")));
  EXPECT_FALSE(result["uploaded"]);
  EXPECT_EQ(on_robot(simulator, "kp"), 60);
  EXPECT_NEAR(on_robot(simulator, "kS_left"), 0.5, 1e-4);
}

std::size_t times(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += word.size()) ++count;
  return count;
}

TEST(Tune, ShowsModelGainsAndEachStepOnceAndEndsWithAVerdict) {
  const Simulator simulator({"--fast", "--motor-mismatch", "0.1"});
  const Outcome offered = tune(simulator, {"--on-ground", "--yes"});
  ASSERT_EQ(offered.code, 0) << offered.err;
  EXPECT_THAT(offered.out, AllOf(HasSubstr("kV [Vs/m]"), HasSubstr("designed  kp"), HasSubstr("predicted"),
                                 HasSubstr("\nVerdict: with the new values the wheels should follow"),
                                 HasSubstr("Nothing was loaded."), HasSubstr("tune.html")));
  const Outcome loaded = tune(simulator, {"--on-ground", "--yes", "--upload"});
  ASSERT_EQ(loaded.code, 0) << loaded.err;
  // Two wheels, each measured and predicted.
  EXPECT_EQ(times(loaded.out, "\nbefore  "), 4U) << loaded.out;
  EXPECT_EQ(times(loaded.out, "\na jump, new gains alone "), 2U) << loaded.out;
  EXPECT_EQ(times(loaded.out, "\nafter "), 4U) << loaded.out;
  EXPECT_EQ(times(loaded.out, "Verdict: "), 1U) << loaded.out;
  EXPECT_THAT(loaded.out, HasSubstr("\nVerdict: with the new values the wheels follow their set point"));
  const Outcome again = tune(simulator, {"--on-ground", "--yes", "--upload", "--json"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(support::parse_json(again.out)["verdict"].get<std::string>(),
              HasSubstr("follow their set point about as well as before"))
      << "the robot holds the same values as at the last step";
}

TEST(Tune, SaysWhenSpeedsCannotBeWhatTheRobotBelieves) {
  const Simulator simulator({"--fast", "--counts-per-rev", "32"});
  const Outcome outcome = tune(simulator, {"--on-ground", "--yes", "--max-distance", "0.8"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("kV is 2 times"), HasSubstr("check-wiring --roll")));
}

TEST(Tune, RefusesABandwidthBeforeAnythingTurns) {
  const Simulator simulator({"--fast"});
  const Outcome outcome = tune(simulator, {"--on-ground", "--yes", "--bandwidth", "50"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("50 Hz is too much"), HasSubstr("at most")));
  EXPECT_FALSE(std::filesystem::exists(report_in(simulator)));
}

TEST(Tune, NamesAWheelThatDoesNotAnswer) {
  const Simulator simulator({"--fast", "--wiring", "right-encoder-reversed"});
  const Outcome outcome = tune(simulator, {"--on-ground", "--yes", "--upload"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("right wheel counts backward"), HasSubstr("check-wiring")));
  EXPECT_EQ(info(simulator)["mode"], "disarmed");
}

TEST(Tune, WantsToKnowWhereTheRobotIsAndWhetherItMay) {
  const Simulator simulator;
  const Outcome nowhere = tune(simulator, {"--yes"});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_THAT(nowhere.err, AllOf(HasSubstr("--on-stand"), HasSubstr("--on-ground")));
  const Outcome unasked = tune(simulator, {"--on-ground"});
  EXPECT_EQ(unasked.code, 1);
  EXPECT_THAT(unasked.err, HasSubstr("--yes"));
}

TEST(Tune, ChecksTheReportsPlaceBeforeAnythingTurns) {
  const Simulator simulator;
  const Outcome outcome = astrolabe(
      {"tune", "--port", simulator.port(), "--on-ground", "--yes", "--out", "/no/such/folder/tune.html"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("/no/such/folder/tune.html"));
}

TEST(Tune, CtrlCStopsAndDisarms) {
  const Simulator simulator(Words{});  // in real time
  support::TerminalProgram program(
      {ASTROLABE_PROGRAM, "tune", "--port", simulator.port(), "--on-stand", "--out", report_in(simulator)});
  ASSERT_TRUE(program.shows("Begin?"));
  program.type("y\n");
  ASSERT_TRUE(program.shows("measuring"));
  program.send(SIGINT);
  EXPECT_EQ(program.wait(), 130) << program.seen();
  EXPECT_EQ(info(simulator)["mode"], "disarmed");
  EXPECT_EQ(info(simulator)["faults"], json::array());
}

}  // namespace
}  // namespace astro
