#include "common/fixed/angle.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace astro {
namespace {

constexpr std::int64_t kHalf = INT64_MIN;  // -1/2 turn; +1/2 does not exist
constexpr std::int64_t kQuarter = std::int64_t{1} << 62;

TEST(Angle, WrapsAtAWholeTurn) {
  Angle angle;
  for (int i = 0; i < 4; ++i) angle = angle + kQuarter;
  EXPECT_EQ(angle, Angle{});
  EXPECT_EQ(Angle{} + -1, Angle::from_raw(~std::uint64_t{0}));
}

TEST(Angle, DifferenceIsTheShortWayRoundAcrossTheWrap) {
  const Angle just_before = Angle{} + -5;
  const Angle just_after = Angle{} + 7;
  EXPECT_EQ(just_after - just_before, 12);
  EXPECT_EQ(just_before - just_after, -12);
}

TEST(Angle, HalfATurnIsMinusHalfATurn) {
  const Angle opposite = Angle{} + kHalf;
  EXPECT_EQ(opposite - Angle{}, kHalf);
  EXPECT_EQ(Angle{} - opposite, kHalf);
}

RC_GTEST_PROP(Angle, TurningAndLookingBackIsTheTurn, (std::uint64_t raw, std::int64_t turn)) {
  const Angle angle = Angle::from_raw(raw);
  RC_ASSERT((angle + turn) - angle == turn);
}

RC_GTEST_PROP(Angle, OrderAndGroupingOfTurnsDoNotMatter,
              (std::uint64_t raw, std::int64_t a, std::int64_t b)) {
  const Angle angle = Angle::from_raw(raw);
  const auto sum = static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
  RC_ASSERT((angle + a) + b == (angle + b) + a);
  RC_ASSERT((angle + a) + b == angle + sum);
}

}  // namespace
}  // namespace astro
