#include "host/console/keys.hpp"

#include <gmock/gmock.h>

namespace astro::console {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(KeyReader, KnowsLettersInBothCasesSpaceAndQ) {
  EXPECT_THAT(KeyReader().read("wWsSaAdD qQ"),
              ElementsAre(Key::forward, Key::forward, Key::backward, Key::backward, Key::left, Key::left,
                          Key::right, Key::right, Key::stop, Key::quit, Key::quit));
}

TEST(KeyReader, KnowsBothCodesOfTheArrows) {
  EXPECT_THAT(KeyReader().read("\033[A\033[B\033[C\033[D"),
              ElementsAre(Key::forward, Key::backward, Key::right, Key::left));
  EXPECT_THAT(KeyReader().read("\033OA\033OB\033OC\033OD"),
              ElementsAre(Key::forward, Key::backward, Key::right, Key::left));
}

TEST(KeyReader, PutsCodesTogetherThatComeInPieces) {
  KeyReader reader;
  EXPECT_THAT(reader.read("\033"), IsEmpty());
  EXPECT_THAT(reader.read("["), IsEmpty());
  EXPECT_THAT(reader.read("A"), ElementsAre(Key::forward));
}

TEST(KeyReader, TakesNoLetterOutOfOtherCodes) {
  // Delete, Page Up, Ctrl-Right, F5, a mouse report: they end in letters or hold digits and are no steering.
  EXPECT_THAT(KeyReader().read("\033[3~\033[5~\033[1;5C\033[15~\033[<0;12;7M"), IsEmpty());
}

TEST(KeyReader, StillKnowsTheKeyAfterALoneEscape) {
  EXPECT_THAT(KeyReader().read("\033 "), ElementsAre(Key::stop));
  EXPECT_THAT(KeyReader().read("\033\033[A"), ElementsAre(Key::forward));
}

TEST(SteeringWheel, ReachesTheMostInFiveStepsAndNotMore) {
  SteeringWheel wheel(0.5, 1.0);
  for (int i = 0; i < 9; ++i) wheel.press(Key::forward);
  EXPECT_EQ(wheel.v_mps(), 0.5);
  for (int i = 0; i < 20; ++i) wheel.press(Key::right);
  EXPECT_EQ(wheel.omega_radps(), -1.0);  // right is negative
}

TEST(SteeringWheel, ComesBackToExactlyNothing) {
  SteeringWheel wheel(0.3, 0.7);
  for (const Key key : {Key::forward, Key::forward, Key::left, Key::backward, Key::backward, Key::right})
    wheel.press(key);
  EXPECT_EQ(wheel.v_mps(), 0.0);
  EXPECT_EQ(wheel.omega_radps(), 0.0);
}

TEST(SteeringWheel, StopsAtOnceOnSpaceAndOnQuit) {
  for (const Key key : {Key::stop, Key::quit}) {
    SteeringWheel wheel(0.3, 0.7);
    wheel.press(Key::forward);
    wheel.press(Key::left);
    wheel.press(key);
    EXPECT_EQ(wheel.v_mps(), 0.0);
    EXPECT_EQ(wheel.omega_radps(), 0.0);
  }
}

}  // namespace
}  // namespace astro::console
