#include "host/calibration/motion/motion_match.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace astro::calibration {
namespace {

constexpr double kBin_s = 0.05;

MotionProfile random_profile(std::size_t bins, double first_s, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  MotionProfile profile{first_s, kBin_s, {}, {}, std::vector<char>(bins, 1)};
  for (std::size_t i = 0; i < bins; ++i) {
    profile.speed_mps.push_back(0.3 + normal(random));
    profile.turn_mps.push_back(0.1 + normal(random));
  }
  return profile;
}

/// Both profiles where they overlap, truth interpolated linearly, bin by bin.
struct Overlap {
  double count = 0, correlation = 0;
};

Overlap overlap_of(const MotionProfile& wheels, const MotionProfile& truth, const ClockGuess& guess) {
  double n = 0, both = 0, wheel_square = 0, truth_square = 0, wheel[2] = {}, body[2] = {};
  for (std::size_t i = 0; i < wheels.known.size(); ++i) {
    const double wheel_s = wheels.first_s + static_cast<double>(i) * kBin_s;
    const double truth_s = guess.truth_s + (wheel_s - guess.robot_s) / (1 + guess.skew);
    const double bin = (truth_s - truth.first_s) / kBin_s, k = std::floor(bin), part = bin - k;
    if (k < 0 || k + 1 >= static_cast<double>(truth.known.size())) continue;
    const auto at = static_cast<std::size_t>(k);
    if (!truth.known[at] || !truth.known[at + 1]) continue;
    const double a[2] = {wheels.speed_mps[i], wheels.turn_mps[i]};
    const double b[2] = {std::lerp(truth.speed_mps[at], truth.speed_mps[at + 1], part),
                         std::lerp(truth.turn_mps[at], truth.turn_mps[at + 1], part)};
    ++n;
    for (int c = 0; c < 2; ++c) {
      wheel[c] += a[c];
      body[c] += b[c];
      wheel_square += a[c] * a[c];
      truth_square += b[c] * b[c];
      both += a[c] * b[c];
    }
  }
  for (int c = 0; c < 2; ++c) {
    wheel_square -= wheel[c] * wheel[c] / n;
    truth_square -= body[c] * body[c] / n;
    both -= wheel[c] * body[c] / n;
  }
  return {n, both / std::sqrt(wheel_square * truth_square)};
}

TEST(MotionMatch, IsTheCorrelationOfTheRatesAtAnyOffsetAndSkew) {
  const MotionProfile wheels = random_profile(900, 7, 1), truth = random_profile(1600, -20, 2);
  const MotionMatch match(wheels, truth, 0);
  int covered = 0;
  for (const double skew : {0.0, 1e-5, -1e-5, 0.003, 0.05, -0.05, 1.0 / 7, 0.5})
    for (const double truth_s : {15.0, 20.0, 21.237}) {
      const ClockGuess guess{25, truth_s, skew};
      const Overlap expected = overlap_of(wheels, truth, guess);
      const Agreement found = match.at(guess);
      ASSERT_GT(expected.count, 500);
      EXPECT_NEAR(found.overlap_s, expected.count * kBin_s, 1e-9) << skew << ' ' << truth_s;
      // The wheels lie within truth, so that nothing is taken off for what is not covered.
      if (expected.count < static_cast<double>(wheels.known.size())) continue;
      ++covered;
      EXPECT_NEAR(found.correlation, expected.correlation, 1e-9) << skew << ' ' << truth_s;
    }
  EXPECT_GT(covered, 12);
}

TEST(MotionMatch, LeavesOutWhatIsNotKnownWhereverItIs) {
  const MotionProfile wheels = random_profile(900, 0, 3);
  MotionProfile truth = random_profile(900, 0, 4);
  std::mt19937_64 random(5);
  for (std::size_t i = 0; i < truth.known.size(); ++i)
    if (i < 20 || i > 870 || (i > 300 && i < 420) || random() % 16 == 0) {
      truth.known[i] = 0;
      truth.speed_mps[i] = truth.turn_mps[i] = 0;
    }
  const MotionMatch match(wheels, truth, 0);
  for (const double skew : {0.0, 1e-4, -0.03, 0.05})
    // Never on a bin of truth, where rounding would say between which two it lies.
    for (const double shift_s : {-30.0123, -0.013, 0.0071, 0.0257, 12.0119}) {
      const ClockGuess guess{20, 20 + shift_s, skew};
      EXPECT_NEAR(match.at(guess).overlap_s, overlap_of(wheels, truth, guess).count * kBin_s, 1e-9)
          << skew << ' ' << shift_s;
    }
}

TEST(MotionMatch, StaysWithinTruthWhereBinsMeetExactly) {
  for (const double bin_s : {0.05, 0.1, 0.2, 0.3})
    for (const std::size_t bins : {400U, 905U, 1000U}) {
      MotionProfile wheels = random_profile(bins, 0, 10), truth = random_profile(bins, 0, 11);
      wheels.bin_s = truth.bin_s = bin_s;
      const MotionMatch match(wheels, truth, 0);
      for (const double skew : {0.0, 0.25, 0.05, -0.05, -0.2, 1.0})
        for (int shift = -100; shift <= 100; shift += 5) {
          const Agreement found = match.at({shift * bin_s, 0, skew});
          EXPECT_GE(found.correlation, -1) << skew << ' ' << shift;
          EXPECT_LE(std::abs(found.correlation), 1) << skew << ' ' << shift;
        }
    }
}

TEST(MotionMatch, HasNothingToSayWithoutOverlap) {
  const MotionMatch match(random_profile(100, 0, 6), random_profile(100, 0, 7), 0);
  for (const double shift_s : {-1e9, -5.1, 5.1, 1e9}) EXPECT_EQ(match.at({0, shift_s, 0}).correlation, -1);
  MotionProfile unknown = random_profile(100, 0, 8);
  unknown.known.assign(unknown.known.size(), 0);
  EXPECT_EQ(MotionMatch(random_profile(100, 0, 9), unknown, 0).at({0, 0, 0}).correlation, -1);
}

}  // namespace
}  // namespace astro::calibration
