#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

namespace astro {
namespace {

using support::astrolabe;
using support::Outcome;
using testing::AllOf;
using testing::HasSubstr;

class Upload : public testing::Test {
 protected:
  std::string calibration(const std::string& parameters) const {
    const std::filesystem::path path = simulator_.folder() / "calib.toml";
    std::ofstream(path) << "[parameters]\n" << parameters;
    return path.string();
  }
  Outcome upload(const std::string& parameters, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"upload", calibration(parameters), "--port", simulator_.port()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return astrolabe(arguments);
  }
  double on_robot(const std::string& name) const {
    const Outcome outcome = astrolabe({"params", "get", name, "--port", simulator_.port(), "--json"});
    return support::parse_json(outcome.out).at("value");
  }

  support::Simulator simulator_;
};

TEST_F(Upload, LoadsChecksAndReadsBack) {
  const Outcome outcome = upload("c_R = 1.002\nc_L = 0.998\nb = 0.289\n", {"--yes", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = support::parse_json(outcome.out);
  EXPECT_EQ(json["active"], "new");
  EXPECT_NEAR(json["parameters"]["b"]["now"], 0.289, 1e-9);  // b is kept in nanometres
  EXPECT_NEAR(on_robot("c_R"), 1.002, 1e-9);                 // c_R in steps of 2^-30
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("c_R"), HasSubstr("0.29"), HasSubstr("0.289")))
      << "old and new side by side";
}

TEST_F(Upload, SaysWhenTheRobotHoldsTheValuesAlready) {
  const Outcome outcome = upload("c_R = 1\n", {"--yes"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("already"));
}

TEST_F(Upload, RefusesMoreThanATenthWithoutForce) {
  EXPECT_EQ(upload("b = 0.33\n", {"--yes"}).code, 1);
  EXPECT_EQ(on_robot("b"), 0.29);
  EXPECT_EQ(upload("b = 0.31\n", {"--yes", "--force"}).code, 0);
  EXPECT_EQ(on_robot("b"), 0.31);
}

TEST_F(Upload, RefusesWhatTheTableDoesNotAllowEvenWithForce) {
  const Outcome outcome = upload("c_R = 1.002\nb = 9\n", {"--yes", "--force"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("b = 9"));
  EXPECT_EQ(on_robot("c_R"), 1) << "all or nothing";
}

TEST_F(Upload, RefusesAParameterThatTheRobotDoesNotHave) {
  const Outcome outcome = upload("c_X = 1\n", {"--yes"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("c_X"));
}

TEST_F(Upload, AsksAndTakesNoAnswerForNo) {
  const Outcome outcome = upload("c_R = 1.002\n", {});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--yes"));
  EXPECT_EQ(on_robot("c_R"), 1);
}

TEST_F(Upload, RefusesACalibrationOfOtherParametersThanTheRobotCarries) {
  const Outcome outcome = upload("c_R = 1.002\n[carried]\nc_R = 1.001\n", {"--yes"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("driven with c_R = 1.001"));
}

TEST_F(Upload, SaysThatAChangeWithinItsErrorMayBeForNothingAndLoadsIt) {
  const Outcome outcome = upload("c_R = 1.0001\n[standard_errors]\nc_R = 0.0001\n", {"--yes"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("no factor changes by more than twice its standard error"));
  EXPECT_NEAR(on_robot("c_R"), 1.0001, 1e-9);
}

TEST_F(Upload, YesDoesNotLoadWhatTheDrivesAdviseAgainstAndForceDoes) {
  for (const char* verdict : {"undecided", "worse"}) {
    const std::string file = std::string("c_R = 1.002\n[verdict]\nverdict = \"") + verdict +
                             "\"\nsentence = \"Keep what it carries.\"\n";
    const Outcome outcome = upload(file, {"--yes"});
    EXPECT_EQ(outcome.code, 3) << verdict;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("warning: Keep what it carries."),
                                   HasSubstr("nothing was changed"), HasSubstr("--force")));
    EXPECT_EQ(on_robot("c_R"), 1) << verdict;
  }
  EXPECT_EQ(upload("c_R = 1.002\n[verdict]\nverdict = \"better\"\n", {"--yes"}).code, 0);
  const Outcome forced =
      upload("c_R = 1.001\n[verdict]\nverdict = \"worse\"\nsentence = \"Worse.\"\n", {"--yes", "--force"});
  EXPECT_EQ(forced.code, 0);
  EXPECT_THAT(forced.err, HasSubstr("warning: Worse."));
  EXPECT_NEAR(on_robot("c_R"), 1.001, 1e-9);
}

TEST_F(Upload, RefusesTheCalibrationOfAnotherRobotOrWheelAndNamesBothIfTheyAreOverridden) {
  const std::string file =
      "c_R = 1.002\n[robot]\nname = \"ASTRO\"\nid = \"00ff\"\n"
      "[nominal]\nwheel_diameter = 0.08\ncounts_per_wheel_turn = 2803.2\n";
  const Outcome refused = upload(file, {"--yes"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("of robot ASTRO (00ff), and this is"));
  EXPECT_EQ(on_robot("c_R"), 1);
  const Outcome forced = upload(file, {"--yes", "--force"});
  EXPECT_EQ(forced.code, 0);
  EXPECT_THAT(forced.err, AllOf(HasSubstr("warning: the calibration is of robot ASTRO (00ff)"),
                                HasSubstr("warning: the calibration refers to a wheel of 0.08 m")));
  EXPECT_NEAR(on_robot("c_R"), 1.002, 1e-9);
}

TEST_F(Upload, ALinkThatDropsLeavesTheOldSetOrTheNewOne) {
  std::vector<std::string> command{
      ASTROLABE_PROGRAM, "upload",          calibration("c_R = 1.002\nc_L = 0.998\n"),
      "--port",          simulator_.port(), "--yes"};
  support::Program program(command);
  ASSERT_TRUE(support::eventually([&] { return !program.err().empty() || !program.running(); }));
  simulator_.program().send(SIGSTOP);  // the robot stops answering during the upload
  poll(nullptr, 0, 300);
  simulator_.program().send(SIGCONT);
  const int code = program.wait();
  const double c_r = on_robot("c_R"), c_l = on_robot("c_L");
  const bool is_old = c_r == 1 && c_l == 1;
  const bool is_new = std::abs(c_r - 1.002) < 1e-9 && std::abs(c_l - 0.998) < 1e-9;
  EXPECT_TRUE(is_old || is_new) << c_r << ' ' << c_l;
  EXPECT_EQ(code == 0, is_new) << program.err();
}

}  // namespace
}  // namespace astro
