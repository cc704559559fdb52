#include "host/simulation/robot/virtual_mocap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace astro::simulation {
namespace {

MocapConfig without_noise() {
  MocapConfig config;
  config.position_sd_m = config.heading_sd_rad = 0;
  return config;
}

std::vector<recording::TruthSample> watch(VirtualMocap& mocap, const sim::Pose& pose, int for_ms) {
  std::vector<recording::TruthSample> samples;
  for (int ms = 0; ms < for_ms; ++ms)
    if (const auto sample = mocap.advance(1000ULL * static_cast<unsigned>(ms), pose))
      samples.push_back(*sample);
  return samples;
}

TEST(VirtualMocap, SeesSixtyTimesASecond) {
  VirtualMocap mocap(without_noise());
  const auto samples = watch(mocap, {}, 10'000);
  EXPECT_EQ(samples.size(), 600U);
  for (std::size_t i = 0; i < samples.size(); ++i)  // never early, late by less than a millisecond
    EXPECT_NEAR(static_cast<double>(samples[i].time_us), static_cast<double>(i) * 1e6 / 60 + 500, 501);
}

TEST(VirtualMocap, SeesThePoseInItsOwnFrame) {
  MocapConfig config = without_noise();
  config.origin = {2, -1, std::acos(-1.0) / 2};
  VirtualMocap mocap(config);
  const auto sample = mocap.advance(0, {3, 0.5, 7});
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->x_m, 2 - 0.5, 1e-12);  // a quarter turn takes x to y and y to -x
  EXPECT_NEAR(sample->y_m, -1 + 3, 1e-12);
  EXPECT_NEAR(sample->theta_rad, 7 + config.origin.theta_rad, 1e-12);
  EXPECT_TRUE(sample->valid);
}

TEST(VirtualMocap, SeesTheBodyWhereItSitsOnTheRobot) {
  MocapConfig config = without_noise();
  config.origin = {};
  config.ahead_m = 0.1;
  config.left_m = 0.02;
  for (const double theta_rad : {0.0, 1.0, 4.0}) {
    VirtualMocap mocap(config);
    const auto sample = mocap.advance(0, {3, 0.5, theta_rad});
    ASSERT_TRUE(sample);
    EXPECT_NEAR(std::hypot(sample->x_m - 3, sample->y_m - 0.5), std::hypot(0.1, 0.02), 1e-12);
    const double bearing_rad = std::atan2(sample->y_m - 0.5, sample->x_m - 3) - theta_rad;
    EXPECT_NEAR(std::remainder(bearing_rad, 2 * std::acos(-1.0)), std::atan2(0.02, 0.1), 1e-12)
        << "to the left";
  }
}

TEST(VirtualMocap, HasWhiteNoiseOfTheStatedSize) {
  MocapConfig config;
  config.origin = {};
  VirtualMocap mocap(config);
  const auto samples = watch(mocap, {}, 1'000'000);
  const auto n = static_cast<double>(samples.size());
  double xx = 0, yy = 0, tt = 0, xy = 0, lag = 0, previous = 0;
  for (const auto& s : samples) {
    xx += s.x_m * s.x_m;
    yy += s.y_m * s.y_m;
    tt += s.theta_rad * s.theta_rad;
    xy += s.x_m * s.y_m;
    lag += s.x_m * previous;
    previous = s.x_m;
  }
  // 60000 samples: a standard deviation is known to 1 / sqrt(2 n) = 0.29 %, a correlation to 0.41 %; five of
  // each.
  EXPECT_NEAR(std::sqrt(xx / n), config.position_sd_m, 0.015 * config.position_sd_m);
  EXPECT_NEAR(std::sqrt(yy / n), config.position_sd_m, 0.015 * config.position_sd_m);
  EXPECT_NEAR(std::sqrt(tt / n), config.heading_sd_rad, 0.015 * config.heading_sd_rad);
  EXPECT_NEAR(xy / std::sqrt(xx * yy), 0, 0.02);
  EXPECT_NEAR(lag / xx, 0, 0.02);
}

TEST(VirtualMocap, GivesTheSameSamplesForTheSameSeedAndOthersForAnother) {
  MocapConfig other;
  other.seed = 2;
  VirtualMocap a((MocapConfig())), b((MocapConfig())), c(other);
  const auto x = [](VirtualMocap& mocap) {
    std::vector<double> all;
    for (const auto& sample : watch(mocap, {}, 1000)) all.push_back(sample.x_m);
    return all;
  };
  const auto first = x(a);
  EXPECT_EQ(first, x(b));
  EXPECT_NE(first, x(c));
}

TEST(VirtualMocap, GoesOnSeeingWhenTheRobotsClockStartsAgain) {
  VirtualMocap mocap(without_noise());
  watch(mocap, {}, 5000);
  mocap.restart_clock();
  EXPECT_EQ(watch(mocap, {}, 1000).size(), 60U);
}

}  // namespace
}  // namespace astro::simulation
