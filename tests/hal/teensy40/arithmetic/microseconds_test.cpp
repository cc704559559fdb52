#include "hal/teensy40/arithmetic/microseconds.hpp"

#include <gtest/gtest.h>

#include <random>

namespace astro::teensy40 {
namespace {

TEST(Microseconds, AreTheCountDividedByTwentyFourWhereverAWordEnds) {
  for (int shift = 0; shift < 64; ++shift)
    for (int nearby = -100; nearby <= 100; ++nearby) {
      const std::uint64_t count = (std::uint64_t{1} << shift) + static_cast<std::uint64_t>(nearby);
      ASSERT_EQ(microseconds(count), count / 24) << count;
    }
}

TEST(Microseconds, AreTheCountDividedByTwentyFourAnywhere) {
  constexpr std::uint64_t kSeed = 24;
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < 1'000'000; ++i) {
    const std::uint64_t count = random() >> random() % 64;
    ASSERT_EQ(microseconds(count), count / 24) << count << ", seed " << kSeed;
  }
}

}  // namespace
}  // namespace astro::teensy40
