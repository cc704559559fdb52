#include "host/live/driver/twist_uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/control/observer.hpp"

namespace astro::live {
namespace {

const OdometryGeometry kThesis{{1, 1, 0.29, 0}, 80.7e-6, 200};

/// Variance of what the robot's own observer makes of whole counts at a constant speed, in (m/s)^2.
double observed_variance(double counts_per_tick) {
  SpeedObserver observer;
  observer.set_gains(SpeedObserver::Gains(200 << 16));
  constexpr int kSettle = 2000, kTicks = 100'000;
  double sum = 0, squares = 0;
  std::int64_t before = 0;
  for (int tick = 1; tick <= kSettle + kTicks; ++tick) {
    const auto now = static_cast<std::int64_t>(std::floor(counts_per_tick * tick));
    observer.advance(static_cast<std::int32_t>(now - before));
    before = now;
    if (tick <= kSettle) continue;
    const double speed = std::ldexp(observer.speed(), -SpeedObserver::kSpeedBits);
    sum += speed;
    squares += speed * speed;
  }
  const double variance = squares / kTicks - sum / kTicks * (sum / kTicks);
  return variance * std::pow(kThesis.count_m * 1000, 2);  // a tick is a millisecond
}

TEST(CountRipple, IsTheLargestOfTheRobotsOwnObserverAtAnySpeed) {
  double largest = 0;
  for (int i = 1; i <= 200; ++i) largest = std::max(largest, observed_variance(0.00137 * i));
  // Speeds are tried in steps, and the observer computes in whole 2^-20 counts.
  EXPECT_NEAR(largest / count_ripple_variance(kThesis), 1, 0.05);
}

TEST(TwistCovariance, OfAStandingRobotIsTheRippleAlone) {
  const TwistCovariance at_rest =
      twist_covariance(0, 0, 0.02, kThesis, {1e-6, calibration::FactorCovariance::Zero()});
  EXPECT_DOUBLE_EQ(at_rest.vv, count_ripple_variance(kThesis) / 2);
  EXPECT_EQ(at_rest.vw, 0);
  EXPECT_DOUBLE_EQ(at_rest.ww, 2 * count_ripple_variance(kThesis) / (0.29 * 0.29));
}

TEST(TwistCovariance, OfSlipIsThatOfTheWayOfAPeriod) {
  OdometryGeometry fine = kThesis;
  fine.count_m = 0;
  // 0.5 m/s for 20 ms is 10 mm; each wheel's way has the variance K 10 mm, and the mean of both half of that.
  const TwistCovariance moving =
      twist_covariance(0.5, 0, 0.02, fine, {1e-6, calibration::FactorCovariance::Zero()});
  EXPECT_NEAR(moving.vv, 1e-6 * 0.01 / 2 / (0.02 * 0.02), 1e-12);
}

TEST(TwistCovariance, OfAFactorIsTheSquareOfWhatItDoesToTheTwist) {
  OdometryGeometry fine = kThesis;
  fine.count_m = 0;
  const double v = 0.4, omega = 0.8, right = v + omega * 0.145, left = v - omega * 0.145;
  const auto of = [&](int factor) {
    calibration::OdometryErrors errors{0, calibration::FactorCovariance::Zero()};
    errors.factors(factor, factor) = 1e-4;
    return twist_covariance(v, omega, 0.02, fine, errors);
  };
  EXPECT_NEAR(of(0).vv, 1e-4 * right * right / 4, 1e-12);
  EXPECT_NEAR(of(0).ww, 1e-4 * right * right / (0.29 * 0.29), 1e-12);
  EXPECT_NEAR(of(1).vw, -1e-4 * left * left / (2 * 0.29), 1e-12);
  EXPECT_NEAR(of(2).ww, 1e-4 * omega * omega / (0.29 * 0.29), 1e-12);
  EXPECT_EQ(of(2).vv, 0);
  EXPECT_GT(of(3).ww, 0);
}

}  // namespace
}  // namespace astro::live
