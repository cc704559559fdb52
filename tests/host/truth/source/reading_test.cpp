#include "host/truth/source/reading.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace astro::truth {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(Reading, OfALengthIsInTheUnitThatItNamesAndOtherwiseInTheChosenOne) {
  EXPECT_DOUBLE_EQ(length_m_in("12", LengthUnit::mm).value(), 0.012);
  EXPECT_DOUBLE_EQ(length_m_in("-1.2", LengthUnit::cm).value(), -0.012);
  EXPECT_DOUBLE_EQ(length_m_in("1.2", LengthUnit::m).value(), 1.2);
  for (const LengthUnit unit : {LengthUnit::mm, LengthUnit::cm, LengthUnit::m})
    for (const char* text : {"12 mm", "12mm", " 1.2 cm ", "0.012m", "+0.012 m", "1.2e-2 m"})
      EXPECT_DOUBLE_EQ(length_m_in(text, unit).value(), 0.012) << text;
}

TEST(Reading, OfAnAngleIsInDegreesOrRadiansOrTwoMarks) {
  EXPECT_DOUBLE_EQ(angle_rad_in("3", AngleUnit::deg).value(), 3 * kDegree);
  EXPECT_DOUBLE_EQ(angle_rad_in("3", AngleUnit::rad).value(), 3);
  EXPECT_DOUBLE_EQ(angle_rad_in("-3 deg", AngleUnit::rad).value(), -3 * kDegree);
  EXPECT_DOUBLE_EQ(angle_rad_in("0.06rad", AngleUnit::deg).value(), 0.06);
  EXPECT_DOUBLE_EQ(angle_rad_in("150/300", AngleUnit::deg).value(), 30 * kDegree);
  EXPECT_DOUBLE_EQ(angle_rad_in("-150 / 300", AngleUnit::deg).value(), -30 * kDegree);
}

TEST(Reading, RefusesAWidthInWordsACommaAndAnUnknownUnit) {
  for (const char* text :
       {"", "twelve", "1,2", "12 in", "12 deg", "mm", "1 2", "nan", "inf", "12 mm cm", "--3"})
    EXPECT_FALSE(length_m_in(text, LengthUnit::mm)) << text;
  for (const char* text : {"", "3 mm", "3,1", "310/300", "1/0", "1/-3", "/3", "3/", "1/2/3", "nan"})
    EXPECT_FALSE(angle_rad_in(text, AngleUnit::deg)) << text;
}

TEST(Reading, IsShownInTheChosenUnit) {
  EXPECT_EQ(shown(0.0123, LengthUnit::mm), "12.3 mm");
  EXPECT_EQ(shown(-0.0123, LengthUnit::cm), "-1.23 cm");
  EXPECT_EQ(shown(0.0123, LengthUnit::m), "0.0123 m");
  EXPECT_EQ(shown(-1e-9, LengthUnit::mm), "0.0 mm");
  EXPECT_EQ(shown(3 * kDegree, AngleUnit::deg), "3.00 deg");
  EXPECT_EQ(shown(0.05, AngleUnit::rad), "0.0500 rad");
}

TEST(Reading, NamesOfUnitsAreReadBack) {
  for (const LengthUnit unit : {LengthUnit::mm, LengthUnit::cm, LengthUnit::m})
    EXPECT_EQ(length_unit_named(name_of(unit)), unit);
  for (const AngleUnit unit : {AngleUnit::deg, AngleUnit::rad})
    EXPECT_EQ(angle_unit_named(name_of(unit)), unit);
  EXPECT_FALSE(length_unit_named("inch"));
}

}  // namespace
}  // namespace astro::truth
