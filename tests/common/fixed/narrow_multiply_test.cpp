#include "common/fixed/narrow_multiply.hpp"

#include <gtest/gtest.h>

#include <array>

#include "common/fixed/multiply.hpp"
#include "tests/common/fixed/seeded.hpp"

// Against the processor's own 64-bit product.
namespace astro {
namespace {

/// Where a half, a sign or a carry changes.
constexpr std::array<std::int32_t, 15> kCorners{
    INT32_MIN, INT32_MIN + 1, -0x1'0000, -0xFFFF,     -0x8000,       -1,       0, 1, 0x7FFF,
    0x8000,    0xFFFF,        0x1'0000,  0x7FFF'0000, INT32_MAX - 1, INT32_MAX};

TEST(NarrowMultiply, WideProductIsExactAtEveryCorner) {
  for (const std::int32_t a : kCorners)
    for (const std::int32_t b : kCorners)
      ASSERT_EQ(narrow::mul_wide(a, b), std::int64_t{a} * b) << a << " * " << b;
}

TEST(NarrowMultiply, WideProductIsExactForNumbersOfAllSizes) {
  tests::Seeded random(61);
  for (int i = 0; i < 1'000'000; ++i) {
    const auto a = static_cast<std::int32_t>(random.any_size(32)),
               b = static_cast<std::int32_t>(random.any_size(32));
    ASSERT_EQ(narrow::mul_wide(a, b), std::int64_t{a} * b) << a << " * " << b;
  }
}

TEST(NarrowMultiply, LowProductKeepsTheLowWordsAlsoWhereTheProductDoesNotFit) {
  tests::Seeded random(62);
  for (int i = 0; i < 1'000'000; ++i) {
    const std::int64_t a = random.any_size(64);
    const auto b = static_cast<std::int32_t>(random.any_size(32));
    ASSERT_EQ(narrow::mul_low(a, b), mul_low(a, b)) << a << " * " << b;
  }
  for (const std::int32_t high : kCorners)
    for (const std::int32_t low : kCorners)
      for (const std::int32_t b : kCorners) {
        const auto a = static_cast<std::int64_t>(std::uint64_t{static_cast<std::uint32_t>(high)} << 32 |
                                                 static_cast<std::uint32_t>(low));
        ASSERT_EQ(narrow::mul_low(a, b), mul_low(a, b)) << a << " * " << b;
      }
}

// The compiler evaluates it, too: an overflow of a signed sum would not compile.
static_assert(narrow::mul_wide(INT32_MIN, INT32_MIN) == std::int64_t{1} << 62);
static_assert(narrow::mul_wide(INT32_MAX, -1) == -std::int64_t{INT32_MAX});
static_assert(narrow::mul_wide(INT32_MAX, 0xFFFF) == std::int64_t{INT32_MAX} * 0xFFFF);
static_assert(narrow::mul_wide(INT32_MIN, INT32_MAX) == std::int64_t{INT32_MIN} * INT32_MAX);

}  // namespace
}  // namespace astro
