#include "host/commands/experiment/wall_dialogue.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "host/wall/wall_plan.hpp"
#include "tests/support/base/columns.hpp"
#include "tests/support/base/person.hpp"

namespace astro::commands {
namespace {

using support::Person;
using testing::HasSubstr;
using wall::WallMove;

wall::WallCourse course() { return wall::plan_course({}, {1, 1, 0.29}); }

TEST(WallDialogue, SaysHowHardAndHowLongAndHowMuchFloorInEightyColumns) {
  const std::string text = wall_briefing({}, course(), 2, 0);
  for (const char* word :
       {"at most\n12 N", "3.9 m", "10\nminutes", "asks twice", "2 m", "Ctrl-C", "wall  ====", "gap"})
    EXPECT_THAT(text, HasSubstr(word));
  EXPECT_LE(support::widest_line(text), 80U) << text;
}

TEST(WallDialogue, SaysWhatIsLeftOfAnEarlierStart) {
  EXPECT_THAT(wall_briefing({}, course(), 0, 400), HasSubstr("about 4"));
}

TEST(WallDialogue, SaysThatTheScaleStaysWithoutARuler) {
  wall::WallPlan plan;
  plan.readings = 0;
  EXPECT_THAT(wall_briefing(plan, course(), 0, 0), HasSubstr("Without a ruler"));
}

TEST(WallDialogue, LetsTheRobotDriveOnEnterAlone) {
  Person person({"wait", "y", " "});
  ask_facing_wall(std::ref(person));
  EXPECT_EQ(person.asked.size(), 3U);
}

TEST(WallDialogue, AsksForAGapUntilItIsALength) {
  Person person({"", "two", "-5", "1998.5", "199.8 cm", "none"});
  EXPECT_NEAR(*ask_gap(std::ref(person), 2.0, truth::LengthUnit::mm), 1.9985, 1e-12);
  EXPECT_EQ(person.asked.size(), 4U);
  EXPECT_THAT(person.asked[0], HasSubstr("by its wheels 2000.0 mm"));
  EXPECT_THAT(person.asked[2], testing::StartsWith("'two' is not a length"));
  EXPECT_NEAR(*ask_gap(std::ref(person), 2.0, truth::LengthUnit::mm), 1.998, 1e-12);
  EXPECT_FALSE(ask_gap(std::ref(person), 2.0, truth::LengthUnit::mm).has_value());
}

TEST(WallDialogue, AsksForNoGapThatWasRead) {
  EXPECT_THAT(wall_briefing({}, course(), 0, 400), testing::Not(HasSubstr("asks")));
  EXPECT_THAT(wall_briefing({}, course(), 1, 400), HasSubstr("asks once"));
}

TEST(WallDialogue, TakesAnotherGapOrAYesAfterADoubt) {
  Person person({"perhaps", "", "1998", "y", "yes", "none"});
  const wall::GapDoubt doubt{wall::GapDoubt::Mistake::unknown, 1.9, true, "1900 mm was read"};
  EXPECT_NEAR(*ask_gap_again(std::ref(person), doubt, truth::LengthUnit::mm), 1.998, 1e-12);
  EXPECT_EQ(person.asked.size(), 3U);
  EXPECT_EQ(ask_gap_again(std::ref(person), doubt, truth::LengthUnit::mm), 1.9);
  EXPECT_EQ(ask_gap_again(std::ref(person), doubt, truth::LengthUnit::mm), 1.9);
  EXPECT_FALSE(ask_gap_again(std::ref(person), doubt, truth::LengthUnit::mm).has_value());
  EXPECT_THAT(person.asked[0], HasSubstr("1900 mm was read"));
  EXPECT_LE(support::widest_line(person.asked[0]), 80U) << person.asked[0];
}

TEST(WallDialogue, TakesNoYesForAGapThatCannotBe) {
  Person person({"yes", "y", "1e308 m", "nan", "1998"});
  const wall::GapDoubt doubt{wall::GapDoubt::Mistake::other_unit, 0.2, false, "200 mm was read"};
  EXPECT_NEAR(*ask_gap_again(std::ref(person), doubt, truth::LengthUnit::mm), 1.998, 1e-12);
  EXPECT_EQ(person.asked.size(), 5U);
  EXPECT_THAT(person.asked[0], HasSubstr("which no calibration mends"));
}

TEST(WallDialogue, EndsWithTheGyroAndHowTheRobotLearnsItsScale) {
  wall::WallResult result;
  result.estimate = wall::estimate_wall({}, {1, 1, 0.29});
  EXPECT_THAT(wall_result_text(result), testing::Not(HasSubstr("gyro")));
  result.gyro.emplace();
  result.gyro->by = experiment::GyroReference::wall;
  result.gyro->scale = {1.0125, 0.0004, 1, 1};
  result.gyro->against_wheels.biases = {{"series 1", 0.01, 0.001}};
  result.gyro->loaded_scale = 0.99;
  result.gyro->names = {"series 1"};
  result.gyro->against_wheels.slips.emplace_back();
  const std::string text = wall_result_text(result);
  EXPECT_THAT(text, HasSubstr("1.01250 ± 0.00040"));
  EXPECT_THAT(text, HasSubstr("gyro_scale=1.00238")) << "what was loaded times what was found";
  EXPECT_THAT(text, testing::Not(HasSubstr("left out"))) << "of whole turns no seconds are";
  EXPECT_LE(support::widest_line(text), 80U) << text;
  result.gyro->scale.scale = -1;
  EXPECT_THAT(wall_result_text(result), HasSubstr("gyro_axis"));
}

TEST(WallDialogue, NamesEveryMove) {
  using Kind = WallMove::Kind;
  EXPECT_EQ(title_of({Kind::repeat, 0.08, 0, 0}), "squaring once more");
  EXPECT_EQ(title_of({Kind::gap, 2, 0, 0}), "2 m off for the ruler");
  EXPECT_EQ(title_of({Kind::laps, 0.2, -2, 3}), "2 laps clockwise");
  EXPECT_EQ(title_of({Kind::spin, 0.2, 1, 0}), "1 turn counter-clockwise");
}

}  // namespace
}  // namespace astro::commands
