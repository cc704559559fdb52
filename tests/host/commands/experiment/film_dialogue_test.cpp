#include "host/commands/experiment/film_dialogue.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "host/commands/experiment/programme_work.hpp"
#include "host/experiment/files/experiment_folder.hpp"
#include "tests/support/base/columns.hpp"
#include "tests/support/base/person.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::commands {
namespace {

using testing::HasSubstr;

experiment::Plan squares_of(double side_m) {
  experiment::Plan plan;
  plan.side_m = side_m;
  plan.runs = 2;
  plan.extras = false;
  return plan;
}

TEST(ProgrammeWork, KnowsTheFieldOfSquaresBothWaysRound) {
  // So long a wheelbase that wheels which differ hardly turn it; a wheelbase that is 1 % off turns it by 4 % of a turn in each square.
  const DrivenField field = field_of(squares_of(3), 1e9);
  EXPECT_NEAR(field.to_ahead_m, 3, 0.6);
  EXPECT_NEAR(field.from_left_m, -3, 0.6);
  EXPECT_NEAR(field.to_left_m, 3, 0.6);
  EXPECT_GT(field.from_ahead_m, -0.6);
}

TEST(ProgrammeWork, LeavesRoomForSquaresThatTurnAboutTheirStart) {
  // 0.5 % of 12 m on 0.29 m: 12 degrees for each square, the same way whichever way round; four of them.
  const DrivenField field = field_of(squares_of(3), 0.29);
  EXPECT_LT(field.from_ahead_m, -1);
  EXPECT_GT(field.to_ahead_m, 3.5);
  EXPECT_GT(field.to_left_m, 3.5);
}

TEST(ProgrammeWork, CountsWhatIsNotRecordedYet) {
  const test::TemporaryFolder folder;
  const experiment::Plan plan = squares_of(3);
  const ProgrammeWork all = work_of(plan, folder.path());
  EXPECT_EQ(all.left, 8) << "two each way, before and after";
  const auto file = experiment::file_of(folder.path(), experiment::runs_of_phase(plan, 0, 2).front());
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << "recorded";
  const ProgrammeWork rest = work_of(plan, folder.path());
  EXPECT_EQ(rest.left, 7);
  EXPECT_EQ(rest.all, 8);
  EXPECT_NEAR(rest.driving_s, all.driving_s * 7 / 8, 1e-9);
  EXPECT_GT(all.driving_s, 8 * 12 / plan.speed_mps);
}

TEST(FilmDialogue, SaysHowLongAndWhereInEightyColumns) {
  const test::TemporaryFolder folder;
  const std::string text = film_briefing(squares_of(2), folder.path(), 0.29);
  std::string one_line = text;
  std::replace(one_line.begin(), one_line.end(), '\n', ' ');
  for (const char* word : {"8 of 8 runs", "minutes", "m ahead", "m back", "m to the left", "m to the right"})
    EXPECT_THAT(one_line, HasSubstr(word));
  EXPECT_LE(support::widest_line(text), 80U) << text;
}

TEST(FilmDialogue, LetsTheRobotDriveOnEnterAlone) {
  support::Person person({"wait", ""});
  ask_filming(std::ref(person), "before");
  EXPECT_EQ(person.asked.size(), 2U);
  EXPECT_THAT(person.asked[0], HasSubstr("film phase 'before'"));
}

}  // namespace
}  // namespace astro::commands
