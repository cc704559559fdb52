#include "common/fixed/wide.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "tests/common/fixed/seeded.hpp"

namespace astro {
namespace {

using Int128 = __int128;
using boost::multiprecision::cpp_int;

constexpr std::int64_t kMost64 = INT64_MAX;
constexpr std::int32_t kMost32 = INT32_MAX, kLeast32 = INT32_MIN;

void expect_exact(std::int64_t a, std::int32_t b) {
  const Int128 expected = (Int128{a} * b + (Int128{1} << 31)) >> 32;
  ASSERT_EQ(mul_high(a, b), static_cast<std::int64_t>(expected)) << a << " * " << b;
}

TEST(MulHigh, IsTheRoundedProductForAllSizesAndExtremes) {
  constexpr std::int64_t kMost = (std::int64_t{1} << 62) - 1;
  for (const std::int64_t a : {-kMost, std::int64_t{-1} << 32, std::int64_t{-1}, std::int64_t{0},
                               std::int64_t{1}, std::int64_t{0x7FFF'FFFF}, std::int64_t{0x8000'0000},
                               std::int64_t{0xFFFF'FFFF}, std::int64_t{1} << 32, kMost})
    for (const std::int32_t b : {kLeast32, kLeast32 + 1, -1, 0, 1, kMost32}) expect_exact(a, b);
  tests::Seeded random(32);
  for (int i = 0; i < 100'000; ++i)
    expect_exact(random.any_size(62), static_cast<std::int32_t>(random.any_size(31)));
}

TEST(MulHigh, RoundsTiesUpwardAlsoBelowZero) {
  EXPECT_EQ(mul_high(std::int64_t{1} << 31, 1), 1);
  EXPECT_EQ(mul_high(std::int64_t{1} << 31, -1), 0);
  EXPECT_EQ(mul_high((std::int64_t{1} << 31) + 1, -1), -1);
  EXPECT_EQ(mul_high(std::int32_t{1} << 30, 2), 1);
  EXPECT_EQ(mul_high(-(std::int32_t{1} << 30), 2), 0);
}

template <int Bits>
void expect_rounded(std::int32_t a, std::int32_t b) {
  const Int128 expected = (Int128{a} * b + (Int128{1} << (Bits - 1))) >> Bits;
  if (expected < kLeast32 || expected > kMost32) return;  // the low 32 bits are not the number
  ASSERT_EQ(mul_rounded<Bits>(a, b), static_cast<std::int32_t>(expected))
      << a << " * " << b << " / 2^" << Bits;
}

TEST(MulRounded, IsTheProductRoundedWithTiesUpward) {
  EXPECT_EQ(mul_rounded<30>(1 << 29, 1), 1);
  EXPECT_EQ(mul_rounded<30>(1 << 29, -1), 0);
  EXPECT_EQ(mul_rounded<30>((1 << 29) + 1, -1), -1);
  EXPECT_EQ(mul_rounded<1>(3, 3), 5);
  EXPECT_EQ(mul_rounded<31>(kLeast32, kLeast32 + 1), kMost32);
  EXPECT_EQ(mul_rounded<30>(1 << 30, kLeast32), kLeast32);
  tests::Seeded random(33);
  for (int i = 0; i < 100'000; ++i) {
    const auto a = static_cast<std::int32_t>(random.any_size(31)),
               b = static_cast<std::int32_t>(random.any_size(31));
    expect_rounded<1>(a, b);
    expect_rounded<28>(a, b);
    expect_rounded<30>(a, b);
    expect_rounded<31>(a, b);
  }
}

TEST(ShiftLeft, ByAllBitsLeavesNothing) {
  EXPECT_EQ(shift_left(5, 0), 5U);
  EXPECT_EQ(shift_left(5, 31), 0x8000'0000U);
  EXPECT_EQ(shift_left(5, 32), 0U);
}

TEST(Accumulate, ASumOfProductsIsTheProductOfTheSumToTheLastBit) {
  tests::Seeded random(10);
  for (int run = 0; run < 1000; ++run) {
    auto rest = static_cast<std::uint32_t>(random.bits() >> 32);
    std::int64_t sum = 0;
    Int128 exact_sum = rest;
    for (int i = 0; i < 100; ++i) {
      const std::int64_t a = random.any_size(61);
      const auto b = static_cast<std::int32_t>(random.any_size(24));
      accumulate(sum, rest, a, b);
      exact_sum += Int128{a} * b;
    }
    ASSERT_TRUE((Int128{sum} << 32) + rest == exact_sum);
  }
}

TEST(Accumulate, HoldsAtTheExtremes) {
  constexpr std::int64_t kMost = (std::int64_t{1} << 62) - 1;
  for (const std::int64_t a :
       {std::int64_t{0x7FFF'FFFF}, std::int64_t{0x8000'0000}, std::int64_t{0xFFFF'FFFF},
        -(std::int64_t{1} << 40), std::int64_t{1} << 40, kMost, -kMost})
    for (const std::int32_t b : {kLeast32, -1, 1, kMost32}) {
      std::uint32_t rest = ~std::uint32_t{0};
      std::int64_t sum = 0;
      accumulate(sum, rest, a, b);
      EXPECT_TRUE((Int128{sum} << 32) + rest == Int128{a} * b + Int128{~std::uint32_t{0}});
    }
}

TEST(Accumulate, CountsTheWrapsOfTheLowPart) {
  tests::Seeded random(11);
  std::int32_t high = 0;
  std::uint64_t low = 0;
  Int128 exact_sum = 0;
  for (int i = 0; i < 100'000; ++i) {
    const std::int64_t step = random.any_size(63);
    accumulate(high, low, step);
    exact_sum += step;
    ASSERT_TRUE((Int128{high} << 64) + Int128{low} == exact_sum);
  }
}

TEST(Isqrt, IsTheLargestRootThatDoesNotExceed) {
  tests::Seeded random(20);
  const auto holds = [](std::uint64_t n) {
    const std::uint64_t r = isqrt(n);
    return r * r <= n && Int128{r + 1} * Int128{r + 1} > Int128{n};
  };
  for (std::uint64_t n = 0; n < 100'000; ++n) ASSERT_TRUE(holds(n)) << n;
  for (int i = 0; i < 100'000; ++i) {
    const std::uint64_t n = random.bits() >> random.between(0, 63);
    ASSERT_TRUE(holds(n)) << n;
  }
  EXPECT_EQ(isqrt(~std::uint64_t{0}), 0xFFFF'FFFFU);
}

TEST(Isqrt, IsExactOnBothSidesOfSquares) {
  tests::Seeded random(21);
  for (int i = 0; i < 10'000; ++i) {
    const std::uint64_t r = random.bits() >> 32 >> random.between(0, 30) | 1U;
    ASSERT_EQ(isqrt(r * r), r);
    ASSERT_EQ(isqrt(r * r - 1), r - 1);
  }
}

struct Formula {
  std::uint64_t start;
  std::vector<std::uint32_t> factors;
  int shift;
  std::vector<std::uint32_t> divisors;

  Natural natural() const {
    Natural n(start);
    for (const std::uint32_t factor : factors) n *= factor;
    n <<= shift;
    for (const std::uint32_t divisor : divisors) n /= divisor;
    return n;
  }
  cpp_int bignum() const {
    cpp_int n = start;
    for (const std::uint32_t factor : factors) n *= factor;
    n <<= shift;
    for (const std::uint32_t divisor : divisors) n /= divisor;
    return n;
  }
};

std::int64_t half_rounded(const cpp_int& n) {
  const cpp_int half = (n + 1) / 2;
  return half > kMost64 ? kMost64 : static_cast<std::int64_t>(half);
}

TEST(Natural, ProductsShiftsAndDivisionsEqualABignumsUpTo256Bits) {
  tests::Seeded random(30);
  const auto limb = [&] {
    return static_cast<std::uint32_t>(random.bits() >> 32 >> random.between(0, 31)) | 1U;
  };
  int within = 0;
  for (int i = 0; i < 100'000; ++i) {
    Formula formula{random.bits(), {}, static_cast<int>(random.between(0, 63)), {}};
    for (std::int64_t n = random.between(0, 4); n > 0; --n)
      formula.factors.push_back(limb());  // 64 + 4*32 + 63 bits
    for (std::int64_t n = random.between(0, 7); n > 0; --n) formula.divisors.push_back(limb());
    const cpp_int expected = formula.bignum();
    ASSERT_EQ(formula.natural().fits_63_bits(), expected <= kMost64) << expected;
    ASSERT_EQ(formula.natural().half_rounded(), half_rounded(expected)) << expected;
    within += expected <= kMost64 ? 1 : 0;
  }
  EXPECT_GT(within, 10'000) << "most cases only saturate: they prove little";
}

TEST(Natural, HoldsTheExtremesOfTheFormulasThatUseIt) {
  // The largest products of geometry.cpp (c_R 1.5, wheel 1 m, gear denominator 10^6, pi, shift 31) and
  // trapezoid.cpp (1 km, shift 42), undone by dividing: nothing was lost at the top.
  const Formula geometry{1'610'612'736, {1'000'000'000, 1'000'000, 14'007'547, 1'503}, 31, {}};
  EXPECT_LT(msb(geometry.bignum()), 256U);
  Formula undone = geometry;
  undone.divisors = {1'503, 14'007'547, 1'000'000, 1'000'000'000, 1U << 31};
  EXPECT_EQ(undone.natural().half_rounded(), 1'610'612'736 / 2);
  EXPECT_EQ((Formula{1'000'000'000'000, {}, 42, {1U << 31, 1U << 11}}.natural().half_rounded()),
            500'000'000'000);
}

TEST(Natural, DividingTwiceIsDividingByTheProduct) {
  tests::Seeded random(31);
  for (int i = 0; i < 10'000; ++i) {
    const std::uint64_t n = random.bits();
    const auto a = static_cast<std::uint32_t>(random.between(1, 65535));
    const auto b = static_cast<std::uint32_t>(random.between(1, 65535));
    Natural once(n), twice(n);
    once /= a * b;
    (twice /= a) /= b;
    ASSERT_EQ(once.half_rounded(), twice.half_rounded()) << n << " " << a << " " << b;
  }
}

TEST(Natural, HalfRoundedRoundsUpAtTheHalfAndSaturates) {
  EXPECT_EQ(Natural(0).half_rounded(), 0);
  EXPECT_EQ(Natural(1).half_rounded(), 1);
  EXPECT_EQ(Natural(2).half_rounded(), 1);
  EXPECT_EQ(Natural(3).half_rounded(), 2);
  EXPECT_EQ(Natural(~std::uint64_t{0} - 1).half_rounded(), kMost64);  // 2^63 - 1 exactly
  EXPECT_EQ(Natural(~std::uint64_t{0}).half_rounded(), kMost64);      // 2^63 saturates
  Natural large(1);
  large <<= 200;
  EXPECT_EQ(large.half_rounded(), kMost64);
}

}  // namespace
}  // namespace astro
