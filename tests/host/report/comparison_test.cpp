#include "host/report/comparison.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "host/report/numbers.hpp"

namespace astro::report {

using calibration::FigureOfMerit;
using calibration::improvement;
using calibration::Improvement;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Comparison, FactorHasNoUpperBoundWhereTheRestCannotBeToldFromZero) {
  const Improvement gain = improvement({405, 40, 5}, {37, 40, 5});
  EXPECT_TRUE(std::isinf(gain.high));
  EXPECT_GT(gain.low, 1);
  EXPECT_THAT(describe(gain), HasSubstr("at least"));
}

TEST(Comparison, ClaimsNoMoreThanTheIntervalBears) {
  EXPECT_EQ(claim(improvement({405, 26, 5}, {90, 12, 5})), "4.5 times smaller");
  const Improvement unbounded = improvement({405, 40, 5}, {37, 40, 5});
  EXPECT_EQ(claim(unbounded),
            "at least " + fixed(unbounded.low, factor_decimals(unbounded.low)) + " times smaller");
  EXPECT_EQ(claim(improvement({90, 12, 5}, {405, 26, 5})), "4.5 times larger");
  for (const FigureOfMerit after : {FigureOfMerit{380, 30, 5}, FigureOfMerit{10, 300, 5}})
    EXPECT_EQ(claim(improvement({405, 40, 5}, after)), "not certainly changed");
  EXPECT_EQ(claim(improvement({400, kNaN, 1}, {100, kNaN, 1})), "4.0 times smaller") << "nothing is known";
}

TEST(Comparison, SaysWhetherTheDifferenceIsSignificant) {
  EXPECT_THAT(verdict_sentence({90, 24, 5}, {405, 30, 5}), HasSubstr("got worse"));
  EXPECT_THAT(verdict_sentence({90, 24, 5}, {37, 30, 5}), HasSubstr("not significant"));
  EXPECT_THAT(verdict_sentence({129, 6, 2}, {15, 15, 2}),
              AllOf(HasSubstr("(7.1 standard errors) is not significant"),
                    HasSubstr("3 in each direction would tell")));
  EXPECT_THAT(verdict_sentence({90, 24, 5}, {90, 30, 5}), testing::EndsWith("it may be chance."));
  EXPECT_THAT(verdict_sentence({405, 0, 5}, {1, 0, 5}), HasSubstr("far beyond the scatter"));
}

}  // namespace astro::report
