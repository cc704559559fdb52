#include "host/commands/experiment/film_dialogue.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

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
