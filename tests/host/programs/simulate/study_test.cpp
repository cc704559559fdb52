#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/support/base/columns.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

// `astrolabe study` and `study merge`, on squares small enough for a test.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::Outcome;
using testing::HasSubstr;
using Words = std::vector<std::string>;

Words study(const Words& more) {
  Words words{"study", "--runs", "1", "--side", "0.5", "--trials", "5"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(StudyCommand, PrintsEveryMethodAndTheBoundWithin80Columns) {
  const Outcome outcome = astrolabe(study({}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* row :
       {"\nuncalibrated", "\numbmark thesis", "\numbmark average", "\nextended published", "\nextended exact",
        "\nml ", "\nCramer-Rao bound", "\nml over the bound", "\nmean errors of ml"})
    EXPECT_THAT(outcome.out, HasSubstr(row));
  EXPECT_LE(support::widest_line(outcome.out), 80U);
  EXPECT_EQ(outcome.err, "") << "progress is for terminals";
}

TEST(StudyCommand, GivesTheSameAsJson) {
  const Outcome outcome = astrolabe(study({"--json", "--clock", "estimated"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json result = support::parse_json(outcome.out);
  EXPECT_EQ(result["setup"]["clock"], "estimated");
  EXPECT_EQ(result["setup"]["model"], "kinematic");
  EXPECT_EQ(result["setup"]["side_m"], 0.5);
  ASSERT_EQ(result["methods"].size(), 6U);
  EXPECT_EQ(result["methods"][5]["name"], "ml");
  EXPECT_EQ(result["methods"][5]["trials"], 5);
  EXPECT_NEAR(result["methods"][0]["rms"]["E_d"].get<double>(), 0.00416, 1e-12) << "what was not calibrated";
  EXPECT_GT(result["bound"]["rms"]["b_over_S"], 0);
  EXPECT_EQ(result["ml_covariance"]["expected"], 4);
}

TEST(StudyCommand, ShowsEOnlyIfTheRobotHasOneOrDrivesCircles) {
  const Outcome usual = astrolabe(study({}));
  EXPECT_THAT(usual.out, testing::Not(HasSubstr("circles")));
  EXPECT_THAT(usual.out, HasSubstr(", expected 4\n"));
  EXPECT_THAT(usual.out, HasSubstr("(median), true 2.645e-06 m\n"));
  const json without = support::parse_json(astrolabe(study({"--json"})).out);
  EXPECT_FALSE(without["bound"]["rms"].contains("e"));
  EXPECT_GT(without["ml_median_K_m"].get<double>(), 0);

  const Words options{"--true-e", "0.02", "--circles", "1", "--radius", "0.5"};
  const Outcome text = astrolabe(study(options));
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("\n1 + 1 circles of 2 turns, radius 0.5 m; e 0.02\n"));
  EXPECT_LE(support::widest_line(text.out), 80U);
  Words as_json = options;
  as_json.push_back("--json");
  const json result = support::parse_json(astrolabe(study(as_json)).out);
  EXPECT_EQ(result["setup"]["e"], 0.02);
  EXPECT_EQ(result["setup"]["circles"], 1);
  EXPECT_NEAR(result["methods"][0]["rms"]["e"].get<double>(), 0.02, 1e-12) << "what was not calibrated";
  EXPECT_GT(result["bound"]["rms"]["e"], 0);
  EXPECT_GT(result["ml_over_bound"]["e"]["value"], 0);
  EXPECT_TRUE(result["ml_mean_errors"]["e"]["value"].is_number());
  EXPECT_FALSE(
      support::parse_json(astrolabe(study({"--circles", "1", "--json"})).out)["ml_over_bound"].contains("e"))
      << "there is none, and the bound knows";
}

TEST(StudyCommand, WindsUpTheKinematicRobotAlone) {
  const Outcome text = astrolabe(study({"--windup", "6"}));
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out,
              HasSubstr("\nspins wind up 6 mrad; a stand of 1 s after each, a line of 0.3 m at the end\n"));
  EXPECT_LE(support::widest_line(text.out), 80U);
  EXPECT_EQ(support::parse_json(astrolabe(study({"--windup", "6", "--json"})).out)["setup"]["windup_rad"],
            0.006);
  const Outcome simulator = astrolabe(study({"--windup", "6", "--model", "simulator"}));
  EXPECT_EQ(simulator.code, 1);
  EXPECT_THAT(simulator.err, HasSubstr("only the robot of the kinematic model does"));
}

TEST(StudyCommand, DrivesTheSimulatedRobotIfAsked) {
  const Outcome text = astrolabe(study({"--model", "simulator"}));
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, testing::StartsWith("simulated robot"));
  EXPECT_LE(support::widest_line(text.out), 80U);
  const Outcome outcome = astrolabe(study({"--model", "simulator", "--json", "--jobs", "2"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result["setup"]["model"], "simulator");
  EXPECT_EQ(result["failures"], json::array());
  EXPECT_NEAR(result["methods"][0]["rms"]["E_d"].get<double>(), 0.00416, 1e-12) << "what was not calibrated";
  EXPECT_EQ(result["methods"][5]["trials"], 5);
}

TEST(StudyCommand, TheSimulatedRobotsCountsComeAtARateOfTheirOwn) {
  const Outcome outcome = astrolabe(study({"--model", "simulator", "--count-rate", "50"}));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("recorded at 100 Hz"));
}

TEST(StudyCommand, ShardsMergedPrintWhatTheWholePrints) {
  const test::TemporaryFolder folder;
  Words merge{"study", "merge"};
  for (const std::string number : {"2", "1", "3"}) {
    const std::string file = (folder.path() / ("part-" + number + ".json")).string();
    const Outcome part = astrolabe(study({"--shard", number + "/3", "--jobs", number, "--out", file}));
    ASSERT_EQ(part.code, 0) << part.err;
    EXPECT_EQ(part.out, "") << "a part is no result";
    EXPECT_THAT(part.err, HasSubstr("of 5 are in '" + file + "'"));
    merge.push_back(file);
  }
  EXPECT_EQ(astrolabe(merge).out, astrolabe(study({})).out);
  merge.push_back("--json");
  EXPECT_EQ(astrolabe(merge).out, astrolabe(study({"--json"})).out);
}

TEST(StudyCommand, CtrlCEndsItWithoutAResult) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "part";
  support::Program program(
      {ASTROLABE_PROGRAM, "study", "--trials", "100000", "--jobs", "2", "--out", file.string()});
  // The file is begun after signals are watched for.
  ASSERT_TRUE(support::eventually([&] { return std::filesystem::exists(file.string() + ".part"); }));
  program.send(SIGINT);
  EXPECT_EQ(program.wait(), 130);
  EXPECT_EQ(program.err(), "astrolabe: interrupted\n");
  EXPECT_EQ(program.out(), "");
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(StudyCommand, SaysThatASquareIsTooLargeForTheErrorsOfTheRobot) {
  const Outcome outcome = astrolabe({"study", "--side", "200", "--trials", "2"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("square of 200 m"), HasSubstr("at most some 54 m")));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
}

TEST(StudyCommand, AnEmptyShardLeavesNothingBehind) {
  const test::TemporaryFolder folder;
  const Outcome outcome = astrolabe(
      {"study", "--trials", "2", "--shard", "3/4", "--out", (folder.path() / "part.json").string()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("shard 3/4 of 2 trials is empty"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(StudyCommand, SaysBeforeTheWorkThatItCannotWrite) {
  const Outcome outcome = astrolabe({"study", "--trials", "100000", "--out", "/proc/none/part.json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("/proc/none"));
}

}  // namespace
}  // namespace astro
