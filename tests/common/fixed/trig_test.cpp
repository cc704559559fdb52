#include "common/fixed/trig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/common/fixed/seeded.hpp"

namespace astro {
namespace {

constexpr std::uint64_t kQuarterTurn = std::uint64_t{1} << 62;
constexpr std::int64_t kOne = std::int64_t{1} << SinCos::kFractionBits;
constexpr long double kBound = 0x1p-35L;  // what trig.hpp promises

SinCos at(std::uint64_t raw) { return sin_cos(Angle::from_raw(raw)); }

long double value(std::int64_t fixed) {
  return std::ldexp(static_cast<long double>(fixed), -SinCos::kFractionBits);
}

// x87 long double has 64 bits of mantissa: the reference is good to about 2^-63, and taking the angle as a
// signed number keeps it small.
long double error(std::uint64_t raw) {
  const SinCos got = at(raw);
  const long double angle = std::ldexp(
      2 * std::numbers::pi_v<long double> * static_cast<long double>(static_cast<std::int64_t>(raw)), -64);
  return std::max(std::fabs(value(got.sin) - std::sin(angle)), std::fabs(value(got.cos) - std::cos(angle)));
}

TEST(SinCos, IsWithinItsBoundOnADenseSweepOfTheTurn) {
  long double worst = 0;
  constexpr std::uint64_t kStep =
      (std::uint64_t{1} << 43) + 12345;  // odd: no two steps see the same low bits
  for (std::uint64_t raw = 0; raw < ~std::uint64_t{0} - kStep; raw += kStep)
    worst = std::max(worst, error(raw));
  RecordProperty("worst_log2", std::to_string(std::log2(worst)));
  EXPECT_LT(worst, kBound);
}

TEST(SinCos, IsWithinItsBoundAtRandomAngles) {
  tests::Seeded random(1);
  long double worst = 0;
  for (int i = 0; i < 1'000'000; ++i) worst = std::max(worst, error(random.bits()));
  EXPECT_LT(worst, kBound);
}

TEST(SinCos, IsWithinItsBoundOnBothSidesOfEveryTableStepAndHalfStep) {
  tests::Seeded random(2);
  for (std::uint64_t half_step = 0; half_step < 512; ++half_step) {
    const std::uint64_t edge = half_step << 55;
    for (const std::int64_t offset :
         {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, random.any_size(24)})
      EXPECT_LT(error(edge + static_cast<std::uint64_t>(offset)), kBound) << half_step << " " << offset;
  }
}

TEST(SinCos, IsExactAtQuarterTurns) {
  const std::int64_t expected[4][2] = {{0, kOne}, {kOne, 0}, {0, -kOne}, {-kOne, 0}};
  for (std::uint64_t quarter = 0; quarter < 4; ++quarter) {
    const SinCos got = at(quarter * kQuarterTurn);
    EXPECT_EQ(got.sin, expected[quarter][0]) << quarter;
    EXPECT_EQ(got.cos, expected[quarter][1]) << quarter;
  }
}

TEST(SinCos, QuarterTurnRotatesByExactlyAQuarter) {
  // The table and the remainder are the same in every quadrant: only signs differ, and rounding down by one unit.
  tests::Seeded random(3);
  for (int i = 0; i < 100'000; ++i) {
    const std::uint64_t raw = random.bits();
    const SinCos here = at(raw);
    const SinCos there = at(raw + kQuarterTurn);
    ASSERT_LE(std::abs(there.sin - here.cos), 2) << raw;
    ASSERT_LE(std::abs(there.cos + here.sin), 2) << raw;
  }
}

TEST(SinCos, SineIsOddAndCosineIsEven) {
  // Both members of a pair may err by the bound, each to its own side.
  const auto most = static_cast<std::int64_t>(2 * kBound * kOne);
  tests::Seeded random(4);
  for (int i = 0; i < 100'000; ++i) {
    const std::uint64_t raw = random.bits();
    const SinCos plus = at(raw);
    const SinCos minus = at(std::uint64_t{0} - raw);
    ASSERT_LE(std::abs(plus.sin + minus.sin), most) << raw;
    ASSERT_LE(std::abs(plus.cos - minus.cos), most) << raw;
  }
}

TEST(SinCos, LiesOnTheUnitCircle) {
  // d(s^2 + c^2) = 2 (s ds + c dc) <= 2 sqrt(2) times the bound.
  tests::Seeded random(5);
  for (int i = 0; i < 100'000; ++i) {
    const std::uint64_t raw = random.bits();
    const SinCos got = at(raw);
    const long double sum = value(got.sin) * value(got.sin) + value(got.cos) * value(got.cos);
    ASSERT_LT(std::fabs(sum - 1), 2.83L * kBound) << raw;
  }
}

}  // namespace
}  // namespace astro
