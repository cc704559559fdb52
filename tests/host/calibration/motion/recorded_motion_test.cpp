#include "host/calibration/motion/recorded_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

// Over what time speeds are taken: as short as the tracker's noise allows.
namespace astro::calibration {
namespace {

constexpr double kSpeed_mps = 0.3, kDriven_s = 60;

/// A minute at 0.3 m/s and a minute at rest: the speed varies by half of that about its mean. Seen without
/// headings.
constexpr double kVaries_mps = kSpeed_mps / 2;
Trajectory on_and_off(double sigma_m, double truth_rate_hz = 60) {
  std::mt19937_64 random(20260801);
  std::normal_distribution<double> noise(0, sigma_m);
  const auto way_m = [](double time_s) { return kSpeed_mps * std::min(time_s, kDriven_s); };
  Trajectory run;
  for (double t = 0; t <= 2 * kDriven_s; t += 0.01) run.wheels.push_back({t, way_m(t), way_m(t)});
  for (double t = 0; t <= 2 * kDriven_s; t += 1 / truth_rate_hz)
    run.truth.push_back({t, way_m(t) + noise(random), noise(random)});
  return run;
}

Window window_of(const Trajectory& run) { return RecordedMotion(run, 0.29, 0).window(); }

TEST(RecordedMotion, TakesSpeedsOverAFifthOfASecondUntilTheirNoiseIsAFifthOfWhatVaries) {
  // Of two positions 0.2 s apart: sqrt(2) sigma / 0.2 s.
  const double limit_m = 0.2 * kVaries_mps * 0.2 / std::sqrt(2);
  const Window inside = window_of(on_and_off(0.9 * limit_m)), outside = window_of(on_and_off(1.1 * limit_m));
  EXPECT_FALSE(inside.averaged);
  EXPECT_EQ(inside.half_s, 0.1);
  EXPECT_TRUE(outside.averaged);
  EXPECT_EQ(outside.half_s, 0.1) << "means of twelve samples each are good enough";
}

TEST(RecordedMotion, TakesThemOverSoLongThatMeansOfItAreGoodEnough) {
  // Of the means of n = rate * width samples each: sqrt(2 / n) sigma / width is a fifth of what varies.
  const auto half_s = [](double sigma_m, double rate_hz) {
    return std::cbrt(2 / rate_hz * std::pow(sigma_m / (0.2 * kVaries_mps), 2)) / 2;
  };
  // 5 %: how well noise is known from 1800 samples and more, and the speed's edges.
  EXPECT_NEAR(window_of(on_and_off(0.05, 60)).half_s / half_s(0.05, 60), 1, 0.05);
  EXPECT_NEAR(window_of(on_and_off(0.10, 60)).half_s / half_s(0.10, 60), 1, 0.05);
  EXPECT_NEAR(window_of(on_and_off(0.05, 15)).half_s / half_s(0.05, 15), 1, 0.05);
  EXPECT_EQ(window_of(on_and_off(0.30, 60)).half_s, 0.5) << "but never over more than a second";
}

}  // namespace
}  // namespace astro::calibration
