#include <gmock/gmock.h>

#include <sstream>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

// `astrolabe plan`.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::Outcome;
using testing::HasSubstr;
using Words = std::vector<std::string>;

json plan(Words options) {
  options.insert(options.begin(), "plan");
  options.push_back("--json");
  const Outcome outcome = astrolabe(options);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return support::parse_json(outcome.out);
}

TEST(PlanCommand, SaysWhatSquaresWillGive) {
  const Outcome outcome = astrolabe({"plan", "--squares", "10", "--side", "3"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("10 squares of 3 m"));
  EXPECT_THAT(outcome.out, HasSubstr("120 m and 10.0 turns in 8 min"));
  EXPECT_THAT(outcome.out, HasSubstr("by the design rules"));
  EXPECT_EQ(astrolabe({"plan"}).out, outcome.out) << "ten are what is planned for if nothing is said";
}

TEST(PlanCommand, FindsTheShortestProgrammeForAPrecision) {
  const json found = plan({"--until", "0.05%"});
  for (const char* factor : {"E_d", "S", "b"})
    EXPECT_LE(found["relative_errors"][factor].get<double>(), 0.0005) << factor;
  EXPECT_EQ(plan({"--until", "0.0005"}), found) << "percent and ratio are the same";
  const json squares = plan({"--until", "0.05%", "--kinds", "squares"});
  EXPECT_EQ(squares["runs"]["lines"], 0);
  EXPECT_GT(squares["driving_time_s"], found["driving_time_s"]);
}

TEST(PlanCommand, TakesTheSizesOfRunsAndTheNoise) {
  const json usual = plan({"--lines", "4", "--spins", "2"});
  EXPECT_GT(usual["distance_m"], 11.9);
  EXPECT_NEAR(plan({"--lines", "4", "--spins", "2", "--length", "6"})["distance_m"].get<double>(), 24, 1e-9);
  EXPECT_LT(plan({"--lines", "4", "--spins", "2", "--turns", "10"})["relative_errors"]["b"],
            usual["relative_errors"]["b"]);
  EXPECT_GT(plan({"--lines", "4", "--spins", "2", "--K", "1e-5"})["relative_errors"]["E_d"],
            usual["relative_errors"]["E_d"]);
  EXPECT_GT(plan({"--lines", "4", "--spins", "2", "--sigma-theta", "5"})["relative_errors"]["b"],
            usual["relative_errors"]["b"]);
  EXPECT_LT(plan({"--circles", "2", "--speed", "0.6"})["driving_time_s"],
            plan({"--circles", "2"})["driving_time_s"]);
  EXPECT_EQ(plan({"--circles", "2"})["design_rules"], json()) << "they take arcs for spins";
}

TEST(PlanCommand, SaysHowPreciselyEIsFoundAndWhatItTakes) {
  const Outcome squares = astrolabe({"plan", "--e", "--squares", "10"});
  EXPECT_EQ(squares.code, 0) << squares.err;
  EXPECT_THAT(squares.out, HasSubstr("standard error of e: 0.02"));
  EXPECT_THAT(squares.out, HasSubstr("\nruns without circles hardly show e: add circles"));
  const Outcome usual = astrolabe({"plan", "--with-e"});
  EXPECT_THAT(usual.out, HasSubstr("6 squares of 3 m, 6 circles of radius 1 m"));
  EXPECT_THAT(usual.out, testing::Not(HasSubstr("hardly")));
  EXPECT_THAT(astrolabe({"plan"}).out, testing::Not(HasSubstr(" e:")));

  const json found = plan({"--until", "0.1%", "--until-e", "0.2%"});
  EXPECT_LE(found["standard_errors"]["e"].get<double>(), 0.002);
  EXPECT_GT(found["runs"]["circles"], 0);
  EXPECT_EQ(found["e_hidden"], json());
  EXPECT_FALSE(plan({})["standard_errors"].contains("e"));
}

TEST(PlanCommand, WantsAPrecisionOfEBesideThatOfTheFactors) {
  EXPECT_EQ(astrolabe({"plan", "--until", "0.1%", "--e"}).code, 2);
  EXPECT_EQ(astrolabe({"plan", "--until-e", "0.1%"}).code, 2);
  const Outcome outcome = astrolabe({"plan", "--until", "0.1%", "--until-e", "0.2%", "--kinds", "squares"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("runs without circles hardly show e"));
}

TEST(PlanCommand, SaysWhichCommandsDriveIt) {
  EXPECT_THAT(astrolabe({"plan", "--lines", "3", "--spins", "2", "--turns", "4"}).out,
              HasSubstr("\n  astrolabe record --lines 3 --spins 2 --turns 4 --truth sim --out programme\n"
                        "  astrolabe calibrate runs programme "));
}

TEST(PlanCommand, OfNoRunsIsRefused) {
  const Outcome outcome = astrolabe({"plan", "--lines", "0"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("the programme is empty: say how many"));
}

TEST(PlanCommand, RefusesInOneSentenceWhatTellsTooLittle) {
  const Outcome outcome = astrolabe({"plan", "--until", "0.05%", "--kinds", "lines"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(
      outcome.err,
      "astrolabe: lines never turn, so they do not determine the wheelbase: add squares, spins or circles\n");
}

}  // namespace
}  // namespace astro
