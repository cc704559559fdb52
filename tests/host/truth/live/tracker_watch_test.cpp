#include "host/truth/live/tracker_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/base/bounded.hpp"

namespace astro::truth {
namespace {

constexpr unsigned kSeed = 11;

/// 100 poses per second of a body, with noise of 0.2 mm and 1 mrad, that arrive evenly 5 ms late.
class Tracker {
 public:
  explicit Tracker(TrackerWatch& watch) : watch_(watch) {}

  void send(int frames, double speed_mps = 0, double yaw_rate_radps = 0) {
    for (int i = 0; i < frames; ++i, now_us += 10'000) {
      x_m_ += 0.01 * speed_mps;
      theta_rad_ += 0.01 * yaw_rate_radps;
      const double half = (theta_rad_ + 0.001 * normal_(random_)) / 2;
      watch_.take({{now_us - 5'000, now_us},
                   {x_m_ + 2e-4 * normal_(random_), 3 + 2e-4 * normal_(random_), 0.2, 0, 0, std::sin(half),
                    std::cos(half)}});
    }
  }
  void lose(int frames) {
    for (int i = 0; i < frames; ++i, now_us += 10'000)
      watch_.take({{now_us - 5'000, now_us}, {0, 0, 0, 0, 0, 0, 0}});
  }

  std::int64_t now_us = 50'000'000;

 private:
  TrackerWatch& watch_;
  std::mt19937_64 random_{kSeed};
  std::normal_distribution<double> normal_;
  double x_m_ = 1, theta_rad_ = 3.1;  // noise passes the half turn
};

TEST(TrackerWatch, TakesBoundedMemoryFromATrackerThatSendsTenTimesAsFastAsAny) {
  const auto taken = support::measured([] {
    TrackerWatch watch(UpAxis::z);
    for (std::int64_t i = 0; i < 300'000; ++i)
      watch.take({{10 * i, 10 * i}, {1e-6 * static_cast<double>(i), 0, 0.2, 0, 0, 0, 1}});
    const TrackerReport report = watch.report(3'000'000);
    EXPECT_NEAR(report.rate_hz, 100'000, 1);
  });
  EXPECT_TRUE(taken.ended);
  if (support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, std::size_t{16} << 20);
  }
}

TEST(TrackerWatch, SeesTheRateAndTheNoiseOfABodyThatStands) {
  TrackerWatch watch(UpAxis::z);
  Tracker tracker(watch);
  tracker.send(1000);
  const TrackerReport report = watch.report(tracker.now_us);
  EXPECT_NEAR(report.rate_hz, 100, 0.01);
  EXPECT_NEAR(static_cast<double>(report.poses), 300, 1) << "of the last three seconds";
  EXPECT_EQ(report.lost, 0U);
  EXPECT_EQ(report.missing, 0U);
  EXPECT_NEAR(report.longest_gap_s, 0.01, 1e-9);
  ASSERT_TRUE(report.rest) << "seed " << kSeed;
  // A standard deviation of 300 samples is good to 4 %, that of two coordinates to 3 %.
  EXPECT_NEAR(report.rest->position_m, 2e-4, 4 * 0.03 * 2e-4) << "seed " << kSeed;
  EXPECT_NEAR(report.rest->heading_rad, 1e-3, 4 * 0.04 * 1e-3) << "seed " << kSeed;
  ASSERT_TRUE(report.pose);
  EXPECT_NEAR(report.pose->y_m, 3, 1e-3);
}

TEST(TrackerWatch, ABodyThatMovesHasNoNoiseAtRest) {
  for (const auto& [speed_mps, yaw_rate_radps] : {std::pair{0.3, 0.0}, {0.001, 0.0}, {0.0, 0.01}}) {
    TrackerWatch watch(UpAxis::z);
    Tracker tracker(watch);
    tracker.send(300, speed_mps, yaw_rate_radps);
    EXPECT_FALSE(watch.report(tracker.now_us).rest) << speed_mps << ' ' << yaw_rate_radps;
  }
}

TEST(TrackerWatch, CountsLostBodiesAndMissingFramesAndMeasuresTheGap) {
  TrackerWatch watch(UpAxis::z);
  Tracker tracker(watch);
  tracker.send(100);
  tracker.lose(20);
  tracker.send(50);
  tracker.now_us += 70'000;  // seven frames that never come
  tracker.send(50);
  const TrackerReport report = watch.report(tracker.now_us);
  EXPECT_EQ(report.poses, 220U);
  EXPECT_EQ(report.lost, 20U);
  EXPECT_EQ(report.missing, 7U);
  EXPECT_NEAR(report.rate_hz, 100, 0.01);
  EXPECT_NEAR(report.longest_gap_s, 0.21, 1e-9);
}

TEST(TrackerWatch, ASilenceUntilNowIsAGap) {
  TrackerWatch watch(UpAxis::z);
  Tracker tracker(watch);
  tracker.send(10);
  EXPECT_NEAR(watch.report(tracker.now_us + 2'000'000).longest_gap_s, 2.01, 1e-9);
  const TrackerReport nothing = watch.report(tracker.now_us + 60'000'000);
  EXPECT_EQ(nothing.poses, 0U);
  EXPECT_EQ(nothing.rate_hz, 0);
  EXPECT_FALSE(nothing.pose);
  EXPECT_FALSE(nothing.rest);
}

}  // namespace
}  // namespace astro::truth
