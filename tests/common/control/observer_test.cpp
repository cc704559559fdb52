#include "common/control/observer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/common/fixed/seeded.hpp"

namespace astro {
namespace {

constexpr std::int32_t kBandwidth_16 = 100 << 16;  // rad/s, the default
constexpr double kCount = 1 << SpeedObserver::kSpeedBits;

SpeedObserver observer(std::int32_t bandwidth_16 = kBandwidth_16) {
  SpeedObserver made;
  made.set_gains(SpeedObserver::Gains(bandwidth_16));
  return made;
}

double speed(const SpeedObserver& observer) { return observer.speed() / kCount; }

TEST(SpeedObserver, HasNoLagAtConstantSpeed) {
  for (const int counts : {1, 3, 12, -1, -12, 1000, -1000}) {
    SpeedObserver seen = observer();
    for (int i = 0; i < 1000; ++i) seen.advance(counts);
    // A tick loses at most one unit of 2^-28 in the speed and one of 2^-20 in the error: both below 1e-4
    // here.
    EXPECT_NEAR(speed(seen), counts, 1e-4) << counts;
  }
}

TEST(SpeedObserver, IsSmoothWhereADifferenceOfCountsTogglesBetweenZeroAndOne) {
  for (const int direction : {1, -1}) {
    SpeedObserver seen = observer();
    double least = 1, most = -1, sum = 0;
    for (int i = 0; i < 4000; ++i) {
      seen.advance(i % 4 == 3 ? direction : 0);
      if (i < 2000) continue;
      least = std::min(least, speed(seen) * direction);
      most = std::max(most, speed(seen) * direction);
      sum += speed(seen) * direction;
    }
    EXPECT_NEAR(sum / 2000, 0.25, 1e-4);
    // The position error is a saw of one count about its mean, and the speed moves by (w T)^2 = 0.01 of it a
    // tick: at most 0.5 * 0.01 * 2 ticks to either side.
    EXPECT_LT(most - least, 0.02);
    EXPECT_GT(most - least, 0.001) << "no ripple at all would be no observer";
  }
}

TEST(SpeedObserver, StepResponseIsThatOfACriticallyDampedLoop) {
  // Two equal poles at r = 1 - w T:  s_n = 1 - r^n (1 + n (1 - r)).
  for (const int bandwidth : {20, 100, 300}) {
    SpeedObserver seen = observer(bandwidth << 16);
    const double r = 1 - bandwidth * 1e-3;
    const double bound = 0x1p-20 / ((1 - r) * (1 - r)) + 1e-5;  // (w T)^2 is kept in 2^-20
    for (int n = 1; n <= 500; ++n) {
      seen.advance(10);
      const double theory = 1 - std::pow(r, n) * (1 + n * (1 - r));
      ASSERT_NEAR(speed(seen) / 10, theory, bound) << bandwidth << " rad/s, tick " << n;
    }
  }
}

TEST(SpeedObserver, DoesNotOvershootAStep) {
  for (const int bandwidth : {1, 20, 100, 500}) {
    SpeedObserver seen = observer(bandwidth << 16);
    for (int n = 0; n < 20'000; ++n) {
      seen.advance(10);
      ASSERT_LE(speed(seen), 10 + 1e-4) << bandwidth << " rad/s, tick " << n;
    }
  }
}

TEST(SpeedObserver, ForwardAndBackwardAreMirrorImages) {
  tests::Seeded random(1);
  SpeedObserver forward = observer(), backward = observer();
  for (int i = 0; i < 10'000; ++i) {
    const std::int32_t counts = random.between32(-15, 15);
    forward.advance(counts);
    backward.advance(-counts);
    ASSERT_NEAR(speed(forward), -speed(backward), 2e-4) << i;  // both round down
  }
}

TEST(SpeedObserver, DoesNotLagBehindAnAccelerationThatItWasToldOf) {
  // 4 m/s^2 on the reference robot: 0.05 counts per tick and tick. Untold it lags by 2 a / w: one count here.
  constexpr double kChange = 0.05;
  SpeedObserver told = observer(), untold = observer();
  double position = 0;
  std::int64_t seen = 0;
  for (int n = 1; n <= 400; ++n) {
    position += kChange * n;
    const auto counts = static_cast<std::int32_t>(std::floor(position) - static_cast<double>(seen));
    seen += counts;
    told.advance(counts, static_cast<std::int32_t>(std::lround(kChange * kCount)));
    untold.advance(counts);
  }
  EXPECT_NEAR(speed(told), 400 * kChange, 0.1);  // a count of quantisation through (w T) to either side
  EXPECT_NEAR(400 * kChange - speed(untold), 2 * kChange / 0.1, 0.15);
}

TEST(SpeedObserver, ForgetsAnAccelerationThatDidNotCome) {
  SpeedObserver seen = observer();
  for (int n = 0; n < 100; ++n) seen.advance(5);
  for (int n = 0; n < 50; ++n) seen.advance(5, 1 << 16);
  for (int n = 0; n < 200; ++n) seen.advance(5);
  EXPECT_NEAR(speed(seen), 5, 1e-3);
}

TEST(SpeedObserver, NoCountsOverflowIt) {
  // Bounded input, bounded speed: counts are limited to 1024 a tick, and nothing overshoots.
  tests::Seeded random(2);
  constexpr std::int32_t kMost = 1025 << SpeedObserver::kSpeedBits;
  for (const int bandwidth : {1, 100, 500}) {
    SpeedObserver seen = observer(bandwidth << 16);
    for (int i = 0; i < 200'000; ++i) {
      const std::int64_t period = std::int64_t{1} << (i / 10'000);
      const bool up = i / period % 2 == 0;
      seen.advance(i % 3 == 0 ? static_cast<std::int32_t>(random.bits()) : (up ? INT32_MAX : INT32_MIN));
      ASSERT_LE(std::abs(seen.speed()), kMost) << bandwidth << " rad/s, tick " << i;
    }
  }
}

TEST(SpeedObserver, NoExpectationOverflowsIt) {
  // The slowest loop recovers last.
  SpeedObserver seen = observer(1 << 16);
  for (int i = 0; i < 200'000; ++i) {
    seen.advance(INT32_MAX, INT32_MAX);
    ASSERT_GE(seen.speed(), 0) << "wrapped in tick " << i;
  }
  EXPECT_NEAR(speed(seen), 1024, 1);
}

TEST(SpeedObserver, ChangingTheBandwidthKeepsTheEstimate) {
  SpeedObserver seen = observer();
  for (int i = 0; i < 1000; ++i) seen.advance(7);
  const double before = speed(seen);
  seen.set_gains(SpeedObserver::Gains(300 << 16));
  EXPECT_EQ(speed(seen), before);
  for (int i = 0; i < 100; ++i) {
    seen.advance(7);
    ASSERT_NEAR(speed(seen), 7, 1e-4);
  }
}

TEST(SpeedObserver, ResetForgetsAll) {
  SpeedObserver seen = observer();
  for (int i = 0; i < 100; ++i) seen.advance(7);
  seen.reset();
  EXPECT_EQ(seen.speed(), 0);
  seen.advance(0);
  EXPECT_EQ(seen.speed(), 0);
}

}  // namespace
}  // namespace astro
