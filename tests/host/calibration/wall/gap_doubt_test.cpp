#include "host/calibration/wall/gap_doubt.hpp"

#include <gtest/gtest.h>

namespace astro::calibration {
namespace {

using Mistake = GapDoubt::Mistake;

constexpr double kExpected_m = 2.013, kKnown = 0.01, kAxle_m = 0.1625, kLength_m = 0.325;

std::optional<GapDoubt> doubt(double read_m) {
  return doubt_about_gap(read_m, kExpected_m, kKnown, kAxle_m, kLength_m);
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
  EXPECT_FALSE(doubt_about_gap(2.04, kExpected_m, 0.01, kAxle_m, kLength_m).has_value());
  EXPECT_TRUE(doubt_about_gap(2.04, kExpected_m, 0.001, kAxle_m, kLength_m).has_value());
  const auto exchanged = doubt_about_gap(2.103, kExpected_m, 0.001, kAxle_m, kLength_m);
  ASSERT_TRUE(exchanged.has_value());
  EXPECT_EQ(exchanged->mistake, Mistake::digit_dropped) << "2103 for 2013";
}

TEST(GapDoubt, SaysWhatWasReadAndWhatWasDriven) {
  const auto found = doubt(0.2010);
  ASSERT_TRUE(found.has_value());
  EXPECT_NE(found->why.find("201 mm was read"), std::string::npos) << found->why;
  EXPECT_NE(found->why.find("backed off by 2013 mm"), std::string::npos) << found->why;
}

}  // namespace
}  // namespace astro::calibration
