#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

// What `plan` finds, driven by `record`.
namespace astro {
namespace {

namespace fs = std::filesystem;
using support::astrolabe;
using support::Outcome;
using support::Simulator;
using testing::HasSubstr;

/// A command as it was printed, but for its folder and without the name of the program.
std::vector<std::string> words_of(const std::string& command, const std::string& folder) {
  std::istringstream text(command);
  std::vector<std::string> words{std::istream_iterator<std::string>(text), {}};
  words.erase(words.begin());
  std::replace(words.begin(), words.end(), std::string("programme"), folder);
  return words;
}

class RecordProgramme : public testing::Test {
 protected:
  std::string folder() const { return (simulator_.folder() / "runs").string(); }
  Outcome record(std::vector<std::string> words) const {
    words.insert(words.begin(), "record");
    words.insert(words.end(), {"--port", simulator_.port(), "--out", folder(), "--truth", "sim"});
    return astrolabe(words);
  }
  // So far off that runs as few as these show it ten times as large as their error.
  Simulator simulator_{{"--fast", "--true-ed", "1.02"}};
};

TEST_F(RecordProgramme, TheCommandsOfAPlanGiveThePrecisionOfThePlan) {
  const Outcome planned = astrolabe({"plan", "--until", "0.2%", "--json"});
  const nlohmann::json plan = support::parse_json(planned.out);
  ASSERT_EQ(plan["commands"].size(), 2U);
  std::vector<std::string> drive = words_of(plan["commands"][0], folder());
  drive.insert(drive.end(), {"--port", simulator_.port()});
  const Outcome driven = astrolabe(drive);
  ASSERT_EQ(driven.code, 0) << driven.err;
  std::vector<std::string> calibrate = words_of(plan["commands"][1], folder());
  calibrate.back() = (simulator_.folder() / "calib.toml").string();
  // The noise of the simulator's wheels and tracker, which plan assumes: estimated from so few runs it scatters by half.
  calibrate.insert(calibrate.end(),
                   {"--K", "2.645e-6", "--sigma-xy", "2e-4", "--sigma-theta", "0.0573", "--json"});
  const Outcome found = astrolabe(calibrate);
  ASSERT_EQ(found.code, 0) << found.err;
  EXPECT_LT(support::parse_json(found.out)["standard_errors"]["E_d"].get<double>(), 2 * 0.002);
}

TEST_F(RecordProgramme, EachRunHasAFileOfItsOwnAndIsNotDrivenAgain) {
  ASSERT_EQ(record({"--lines", "1", "--spins", "3", "--length", "0.3", "--turns", "1"}).code, 0);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder()))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, testing::UnorderedElementsAre("line-1.mcap", "spin-cw-1.mcap", "spin-ccw-1.mcap",
                                                   "spin-cw-2.mcap"));
  const Outcome more = record({"--lines", "2", "--length", "0.3"});
  EXPECT_EQ(more.code, 0);
  EXPECT_EQ(more.err, "1 of 2 runs are recorded already\nrecorded line 2\n");
  const Outcome again = record({"--lines", "2", "--length", "0.3"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, testing::AllOf(HasSubstr("all of these runs already"), HasSubstr("another folder")));
}

TEST_F(RecordProgramme, SaysBeforehandThatRunsWithoutTruthCannotBeCalibratedFrom) {
  const Outcome outcome = astrolabe(
      {"record", "--lines", "1", "--length", "0.3", "--port", simulator_.port(), "--out", folder()});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, testing::StartsWith("without --truth nothing can be calibrated"));
}

}  // namespace
}  // namespace astro
