#include "host/calibration/motion/wheel_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace astro::calibration {
namespace {

std::vector<WheelSample> sampled(double period_s, int count, auto travel) {
  std::vector<WheelSample> samples;
  for (int i = 0; i < count; ++i)
    samples.push_back({i * period_s, travel(i * period_s), -travel(i * period_s)});
  return samples;
}

TEST(WheelPath, GoesThroughItsSamples) {
  const auto samples = sampled(0.05, 40, [](double t) { return std::sin(3 * t); });
  const WheelPath path(samples);
  for (const WheelSample& sample : samples) EXPECT_NEAR(path.at(sample.time_s).left_m, sample.left_m, 1e-15);
}

TEST(WheelPath, IsExactForConstantAcceleration) {
  const auto samples = sampled(0.05, 40, [](double t) { return 0.25 * t * t; });
  const WheelPath path(samples);
  // The first and the last interval lack a neighbour, and with it the right slope.
  for (double t = 0.05; t < 1.9; t += 0.0071) {
    EXPECT_NEAR(path.at(t).left_m, 0.25 * t * t, 1e-14) << t;
    EXPECT_NEAR(path.at(t).left_mps, 0.5 * t, 1e-13) << t;
    EXPECT_NEAR(path.at(t).right_m, -0.25 * t * t, 1e-14) << t;
  }
}

TEST(WheelPath, HasARateThatDoesNotJump) {
  const auto samples = sampled(0.1, 30, [](double t) { return t < 1 ? 0 : t - 1; });
  const WheelPath path(samples);
  for (int i = 1; i < 28; ++i)
    EXPECT_NEAR(path.at(i * 0.1 - 1e-9).left_mps, path.at(i * 0.1 + 1e-9).left_mps, 1e-6) << i;
}

TEST(WheelPath, StandsStillBeforeAndAfter) {
  const auto samples = sampled(0.1, 10, [](double t) { return 2 + t; });
  const WheelPath path(samples);
  EXPECT_EQ(path.at(-5).left_m, 2);
  EXPECT_EQ(path.at(-5).left_mps, 0);
  EXPECT_EQ(path.at(77).left_m, samples.back().left_m);
  EXPECT_EQ(path.at(77).right_mps, 0);
}

TEST(WheelPath, AnswersInAnyOrder) {
  const auto samples = sampled(0.01, 1000, [](double t) { return std::cos(t); });
  const WheelPath path(samples), fresh(samples);
  for (const double t : {7.3, 0.2, 9.9, 5.0, 5.001, 0.0, 9.985, 3.3})
    EXPECT_EQ(path.at(t).left_m, WheelPath(samples).at(t).left_m) << t;
}

}  // namespace
}  // namespace astro::calibration
