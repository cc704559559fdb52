#include "host/wall/gap_doubt.hpp"

#include <gtest/gtest.h>

namespace astro::wall {
namespace {

using Mistake = GapDoubt::Mistake;

constexpr double kExpected_m = 2.013, kKnown = 0.01, kAxle_m = 0.1625, kLength_m = 0.325;

std::optional<GapDoubt> doubt(double read_m, double known = kKnown, bool read_before = false) {
  return doubt_about_gap(read_m, {kExpected_m, known, kExpected_m, read_before}, kAxle_m, kLength_m);
}

void expect(double read_m, Mistake mistake) {
  const auto found = doubt(read_m);
  ASSERT_TRUE(found.has_value()) << read_m;
  EXPECT_EQ(found->mistake, mistake) << found->why;
}

TEST(GapDoubt, IsSilentAboutWhatAnUnknownScaleExplains) {
  for (const double off : {-0.06, -0.01, 0.0, 0.02, 0.06})
    EXPECT_FALSE(doubt(kExpected_m + off).has_value()) << off;
}

TEST(GapDoubt, NamesTheMistakeThatExplainsAReading) {
  expect(0.2010, Mistake::other_unit);
  expect(20.1, Mistake::other_unit);
  expect(2013.0, Mistake::other_unit);
  expect(0.002013, Mistake::other_unit);
  expect(kExpected_m + 0.165, Mistake::to_the_axle);
  expect(kExpected_m + 0.33, Mistake::to_the_rear);
  expect(0.213, Mistake::digit_dropped);
  expect(1.5, Mistake::unknown);
}

TEST(GapDoubt, IsStricterOnceTheScaleIsKnown) {
  EXPECT_FALSE(doubt(2.04, 0.01).has_value());
  EXPECT_TRUE(doubt(2.04, 0.001).has_value());
  const auto exchanged = doubt(2.103, 0.001);
  ASSERT_TRUE(exchanged.has_value());
  EXPECT_EQ(exchanged->mistake, Mistake::digit_dropped) << "2103 for 2013";
}

TEST(GapDoubt, SaysWhatWasReadAndWhatWasDriven) {
  const auto found = doubt(0.2010);
  ASSERT_TRUE(found.has_value());
  EXPECT_NE(found->why.find("201 mm was read"), std::string::npos) << found->why;
  EXPECT_NE(found->why.find("backed off by 2013 mm"), std::string::npos) << found->why;
}

TEST(GapDoubt, NamesTheReadingBeforeIfThatIsWhatContradicts) {
  const auto found = doubt(1.9, 0.0005, true);
  ASSERT_TRUE(found.has_value());
  EXPECT_NE(found->why.find("where 2013 mm would be right by the reading before"), std::string::npos)
      << found->why;
}

TEST(GapDoubt, HoldsNoGapForPossibleThatMakesWheelsAFifthLarger) {
  for (const double read_m : {0.2013, 1.5, 2.45, 20.13, 2013.0, 1e5}) {
    ASSERT_TRUE(doubt(read_m).has_value()) << read_m;
    EXPECT_FALSE(doubt(read_m)->possible) << read_m;
  }
  for (const double read_m : {1.7, 2.103, 2.38}) {
    ASSERT_TRUE(doubt(read_m).has_value()) << read_m;
    EXPECT_TRUE(doubt(read_m)->possible) << read_m;
  }
}

TEST(GapDoubt, MeasuresWhatIsPossibleByTheLoadedWheelWhateverWasReadBefore) {
  // An earlier reading that was wrong in the same way makes this one expected, and no better.
  const auto found = doubt_about_gap(1.2, {1.2, 0.001, kExpected_m, true}, kAxle_m, kLength_m);
  ASSERT_TRUE(found.has_value());
  EXPECT_FALSE(found->possible);
}

}  // namespace
}  // namespace astro::wall
