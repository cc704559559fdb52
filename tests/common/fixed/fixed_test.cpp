#include "common/fixed/fixed.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace astro {
namespace {

using Int128 = __int128;

std::int32_t saturated(Int128 value) {
  return static_cast<std::int32_t>(std::clamp<Int128>(value, INT32_MIN, INT32_MAX));
}

/// floor(a * b / 2^F + 1/2), in one line and with room to spare.
template <int F>
Int128 rounded_product(std::int32_t a, std::int32_t b) {
  return F == 0 ? Int128{a} * b : (Int128{a} * b + (Int128{1} << F >> 1)) >> F;
}

template <int F>
void obeys_its_laws(std::int32_t a, std::int32_t b, std::int32_t c) {
  using Q = Fixed<F>;
  const Q x = Q::from_raw(a), y = Q::from_raw(b), z = Q::from_raw(c);
  RC_ASSERT((x + y).raw() == saturated(Int128{a} + b));
  RC_ASSERT((x - y).raw() == saturated(Int128{a} - b));
  RC_ASSERT((-x).raw() == saturated(-Int128{a}));
  RC_ASSERT((x * y).raw() == saturated(rounded_product<F>(a, b)));
  RC_ASSERT(Int128{x.scale(b)} == rounded_product<F>(a, b));
  RC_ASSERT(x + y == y + x);
  RC_ASSERT(x * y == y * x);
  RC_ASSERT((x < y) == (a < b));
  if (a <= b) RC_ASSERT(x + z <= y + z);  // saturation keeps order
}

RC_GTEST_PROP(Fixed, SumsAndProductsAreExactThenRoundedThenSaturated,
              (std::int32_t a, std::int32_t b, std::int32_t c)) {
  obeys_its_laws<0>(a, b, c);
  obeys_its_laws<1>(a, b, c);
  obeys_its_laws<16>(a, b, c);
  obeys_its_laws<30>(a, b, c);
  obeys_its_laws<31>(a, b, c);
}

// Generated integers are small more often than not: these reach the ends of the range.
RC_GTEST_PROP(Fixed, TheLawsHoldNearTheEnds, (bool low_a, bool low_b, std::uint16_t da, std::uint16_t db)) {
  const std::int32_t a = low_a ? INT32_MIN + da : INT32_MAX - da;
  const std::int32_t b = low_b ? INT32_MIN + db : INT32_MAX - db;
  obeys_its_laws<0>(a, b, da);
  obeys_its_laws<16>(a, b, -db);
  obeys_its_laws<31>(a, b, a);
}

RC_GTEST_PROP(Fixed, OneChangesNothingAndZeroTakesAll, (std::int32_t raw)) {
  const Q16 x = Q16::from_raw(raw);
  RC_ASSERT(x * Q16(1.0) == x);
  RC_ASSERT(x * Q16(0.0) == Q16(0.0));
  RC_ASSERT(x + Q16(0.0) == x);
}

TEST(Fixed, RoundsTiesUpward) {
  const Q16 half = Q16(0.5);
  EXPECT_EQ((half * Q16::from_raw(1)).raw(), 1);
  EXPECT_EQ((half * Q16::from_raw(-1)).raw(), 0);
  EXPECT_EQ((half * Q16::from_raw(-3)).raw(), -1);
  EXPECT_EQ(half.scale(7), 4);
  EXPECT_EQ(half.scale(-7), -3);
}

TEST(Fixed, SaturatesWhereTwosComplementWouldTurnAround) {
  const Q16 least = Q16::from_raw(INT32_MIN), most = Q16::from_raw(INT32_MAX);
  EXPECT_EQ(-least, most);
  EXPECT_EQ(least - most, least);
  EXPECT_EQ(least * least, most);
  EXPECT_EQ(least * most, least);
  EXPECT_EQ(Fixed<31>::from_raw(INT32_MIN) * Fixed<31>::from_raw(INT32_MIN), Fixed<31>::from_raw(INT32_MAX));
}

TEST(Fixed, LiteralsAreTheNearestStep) {
  static_assert(Q16(1.0).raw() == 65536);
  static_assert(Q16(-1.5).raw() == -98304);
  static_assert(Fixed<30>(0.1).raw() == 107374182);                     // 107374182.4
  static_assert(Q16(0x1p-17).raw() == 1 && Q16(-0x1p-17).raw() == -1);  // a tie goes away from zero
  static_assert(Q16(32767.9999847412109375).raw() == INT32_MAX && Q16(-32768.0).raw() == INT32_MIN);
}

TEST(ClampAbs, HoldsAValueWithinTheLimitOnBothSides) {
  for (int limit = 0; limit < 5; ++limit)
    for (int value = -10; value <= 10; ++value)
      EXPECT_EQ(clamp_abs(value, limit), std::clamp(value, -limit, limit));
}

}  // namespace
}  // namespace astro
