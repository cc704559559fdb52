#include "host/commands/experiment/tape_dialogue.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "tests/support/base/person.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::commands {
namespace {

using experiment::Redo;
using experiment::RunSpec;
using support::Person;
using testing::HasSubstr;

const RunSpec kFirst{"before", "square", Sense::cw, 1}, kSecond{"before", "square", Sense::ccw, 1};

TEST(TapeDialogue, AsksForAUnitUntilItIsOneAndTakesMillimetresForEnter) {
  Person person({"inch", "cm", ""});
  EXPECT_EQ(ask_length_unit(std::ref(person)), truth::LengthUnit::cm);
  EXPECT_EQ(ask_length_unit(std::ref(person)), truth::LengthUnit::mm);
  EXPECT_THAT(person.asked[1], testing::StartsWith("'inch' is no answer to this.\nUnit of the lengths"));
}

TEST(TapeDialogue, OffersToCorrectTheLastRunOnlyWhereThereIsOne) {
  Person person({"", "back", "redo", ""});
  EXPECT_EQ(ask_ready(std::ref(person), kFirst, {}), Redo::no);
  EXPECT_EQ(ask_ready(std::ref(person), kSecond, kFirst), Redo::enter_again);
  EXPECT_EQ(ask_ready(std::ref(person), kSecond, kFirst), Redo::drive_again);
  EXPECT_EQ(ask_ready(std::ref(person), kSecond, kFirst), Redo::no);
  EXPECT_THAT(person.asked[0], testing::Not(HasSubstr("redo")));
  EXPECT_THAT(person.asked[1], testing::AllOf(HasSubstr("corrects before: square cw 1"),
                                              HasSubstr("next is before: square ccw 1")));
}

TEST(TapeDialogue, LetsTheRobotDriveOnEnterAlone) {
  Person hesitant({"no wait, not yet", "y", " ", "wait", "back", "stop", ""});
  EXPECT_EQ(ask_ready(std::ref(hesitant), kFirst, {}), Redo::no);
  EXPECT_EQ(hesitant.asked.size(), 3U);
  EXPECT_THAT(hesitant.asked[1], testing::AllOf(HasSubstr("'no wait, not yet' is no answer"),
                                                HasSubstr("next is before: square cw 1")));
  EXPECT_EQ(ask_ready(std::ref(hesitant), kSecond, kFirst), Redo::enter_again);
  EXPECT_EQ(hesitant.asked.size(), 5U);
  ask_put_back(std::ref(hesitant), kFirst);
  EXPECT_EQ(hesitant.asked.size(), 7U);
}

TEST(TapeDialogue, DoesNotTakeEnterForAnAnswerAboutADoubtfulRun) {
  Person person({"", "perhaps", "y", "back", "redo"});
  const experiment::DoubtfulRun run{kFirst, "before: square cw 1: x = 3 mm"};
  EXPECT_EQ(ask_about(std::ref(person), run), Redo::no);
  EXPECT_EQ(person.asked.size(), 3U);
  EXPECT_EQ(ask_about(std::ref(person), run), Redo::enter_again);
  EXPECT_EQ(ask_about(std::ref(person), run), Redo::drive_again);
}

TEST(TapeBriefing, CountsRunsReadingsAndMinutesAndFitsInto80Columns) {
  experiment::Plan plan;
  plan.truth = "manual";
  const test::TemporaryFolder folder;
  const std::string text = tape_briefing(plan, folder.path());
  // A square of 3 m at 0.3 m/s and 1 rad/s: 40 s of legs, 6.3 s of spins and 8 s of stops; a line 11 s. 20 squares and 6
  // lines are 19 minutes, and 26 runs of 2 minutes 52.
  EXPECT_THAT(text, testing::AllOf(HasSubstr("26 of 26 runs"), HasSubstr("before: 5 + 5 squares and 3 lines"),
                                   HasSubstr("78"), HasSubstr("71 minutes"), HasSubstr("19 of"),
                                   HasSubstr("x, ahead")));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

TEST(TapeBriefing, CountsWhatIsLeftOfAnExperimentThatGoesOn) {
  experiment::Plan plan;
  plan.truth = "manual";
  plan.extras = false;
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "before");
  std::ofstream(folder.path() / "before" / kFirst.file_name()) << "recorded";
  EXPECT_THAT(tape_briefing(plan, folder.path()), HasSubstr("19 of 20 runs"));
}

}  // namespace
}  // namespace astro::commands
