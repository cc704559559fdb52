#include "host/calibration/likelihood/huber.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <random>

#include "host/calibration/likelihood/innovation.hpp"

namespace astro::calibration {
namespace {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

constexpr unsigned kSeed = 3;
constexpr double kLimit = 11.345;

Matrix random_covariance(std::mt19937_64& random, double size) {
  std::normal_distribution<double> normal(0, std::sqrt(size));
  Matrix a;
  for (double& value : a.reshaped()) value = normal(random);
  return a * a.transpose();
}

constexpr RobustMode kBoth[] = {RobustMode::tracker, RobustMode::tracker_and_wheels};

TEST(Huber, CostFallsAsTheWeightSaysWhateverOutweighsWhat) {
  std::printf("seed %u\n", kSeed);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  const Vector tracker(1, 1, 4);
  for (const RobustMode robust : kBoth)
    for (const double slip_size : {1e-6, 0.1, 1.0, 10.0, 1e4})
      for (const double far : {1.0, 5.0, 50.0, 1000.0}) {
        const Matrix slip = random_covariance(random, slip_size);
        const Vector r = far * Vector(normal(random), normal(random), normal(random));
        const HuberLoss loss = huber_loss(r, slip, tracker, kLimit, robust);
        const Matrix s = loss.slip * slip + loss.tracker * Matrix(tracker.asDiagonal());
        const Vector slope = 2 * s.inverse() * r;
        for (int i = 0; i < 3; ++i) {
          const double step = 1e-5 * far;
          Vector up = r, down = r;
          up[i] += step;
          down[i] -= step;
          const double measured = (huber_loss(up, slip, tracker, kLimit, robust).cost -
                                   huber_loss(down, slip, tracker, kLimit, robust).cost) /
                                  (2 * step);
          EXPECT_NEAR(measured, slope[i], 1e-5 * (1 + slope.norm())) << slip_size << ' ' << far;
        }
      }
}

/// Along s and then t by golden sections, from outside: slow, and knows nothing of slopes.
double least_cost(const Matrix& slip, const Vector& tracker, const Vector& r) {
  const auto cost = [&](double s, double t) {
    const Matrix total = s * slip + t * Matrix(tracker.asDiagonal());
    return r.dot(total.inverse() * r) + kLimit * (s - 1) + kLimit * (t - 1);
  };
  const auto least = [](double most, const auto& of) {
    double from = 0, to = std::log(most);
    constexpr double kGolden = 0.6180339887;
    for (int i = 0; i < 80; ++i) {
      const double a = to - kGolden * (to - from), b = from + kGolden * (to - from);
      (of(std::exp(a)) < of(std::exp(b)) ? to : from) = of(std::exp(a)) < of(std::exp(b)) ? b : a;
    }
    return of(std::exp((from + to) / 2));
  };
  return least(1e6, [&](double s) { return least(1e6, [&](double t) { return cost(s, t); }); });
}

TEST(Huber, FindsTheLeastCostAlsoWhereSlipAndTrackerAreMuchAlike) {
  std::printf("seed %u\n", kSeed);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  const Vector tracker(1, 1, 4);
  for (const double alike : {0.97, 0.99, 1.0, 1.01, 1.03})
    for (const double mixed : {0.0, 0.1})
      for (const double far : {5.0, 30.0, 1000.0}) {
        const Matrix slip = alike * Matrix(tracker.asDiagonal()) + random_covariance(random, mixed);
        const Vector r = far * Vector(normal(random), normal(random), normal(random));
        const double expected = least_cost(slip, tracker, r);
        const double found = huber_loss(r, slip, tracker, kLimit, RobustMode::tracker_and_wheels).cost;
        EXPECT_NEAR(found, expected, 1e-6 * (1 + expected)) << alike << ' ' << mixed << ' ' << far;
      }
}

TEST(Huber, IsTheUsualOneWithoutSlip) {
  const Vector r(30, 0, 0), tracker(1, 1, 1);
  for (const RobustMode robust : kBoth) {
    const HuberLoss loss = huber_loss(r, Matrix::Zero(), tracker, kLimit, robust);
    EXPECT_NEAR(loss.cost, 2 * std::sqrt(kLimit) * 30 - kLimit, 1e-9);
    EXPECT_NEAR(loss.tracker, 30 / std::sqrt(kLimit), 1e-9);
    EXPECT_EQ(loss.slip, 1);
  }
}

TEST(Huber, IsLeastSquaresWhereSlipExplainsTheMiss) {
  const Vector r(30, 0, 0), tracker(1, 1, 1);
  for (const RobustMode robust : kBoth) {
    const HuberLoss loss = huber_loss(r, 100 * Matrix::Identity(), tracker, kLimit, robust);
    EXPECT_EQ(loss.tracker, 1);
    EXPECT_EQ(loss.slip, 1);
    EXPECT_NEAR(loss.cost, 900.0 / 101, 1e-12);
  }
}

TEST(Huber, DownWeightsTheWheelsWhereTheirSlipOutweighsTheTracker) {
  const Vector r(300, 0, 0), tracker(1, 1, 1);
  const HuberLoss loss =
      huber_loss(r, 100 * Matrix::Identity(), tracker, kLimit, RobustMode::tracker_and_wheels);
  // w = r / (100 s + 1) with 100 w^2 at the limit.
  EXPECT_NEAR(loss.slip, (300 * std::sqrt(100 / kLimit) - 1) / 100, 1e-9);
  EXPECT_EQ(loss.tracker, 1);
  // Wheels that are believed explain it all.
  EXPECT_EQ(huber_loss(r, 100 * Matrix::Identity(), tracker, kLimit, RobustMode::tracker).slip, 1);
}

TEST(Huber, GrowsNoFasterThanTheDistance) {
  const Vector tracker(1, 1, 1);
  const Matrix slip = 4 * Matrix::Identity();
  const auto cost = [&](double far) {
    return huber_loss({far, 0, 0}, slip, tracker, kLimit, RobustMode::tracker_and_wheels).cost;
  };
  // The wheels are doubted, which slip by 2 where the tracker errs by 1.
  EXPECT_NEAR((cost(2e4) - cost(1e4)) / 1e4, 2 * std::sqrt(kLimit / 4), 1e-6);
}

// What the filter relies on where there are no headings: see Update in kalman_filter.hpp.
TEST(Huber, AConstantThatNothingDependsOnChangesNothing) {
  std::printf("seed %u\n", kSeed);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  for (const RobustMode robust : kBoth)
    for (const double far : {1.0, 5.0, 50.0, 1000.0}) {
      Matrix slip = Matrix::Zero();
      slip.topLeftCorner<2, 2>() = random_covariance(random, 10).topLeftCorner<2, 2>();
      const Vector r(far * normal(random), far * normal(random), 0);
      const HuberLoss unit = huber_loss(r, slip, {1, 1, 1}, kLimit, robust);
      for (const double variance : {1e-6, 1e3}) {
        const HuberLoss other = huber_loss(r, slip, {1, 1, variance}, kLimit, robust);
        // Newton's method ends where a step changes the factors by less than 1e-9 of them.
        EXPECT_NEAR(other.cost, unit.cost, 1e-8 * unit.cost) << far << ' ' << variance;
        EXPECT_NEAR(other.slip, unit.slip, 1e-6 * unit.slip) << far << ' ' << variance;
        EXPECT_NEAR(other.tracker, unit.tracker, 1e-6 * unit.tracker) << far << ' ' << variance;
      }
    }
}

/// A second of a line between two looks, the second of which is far out.
TEST(Huber, MakesTheCostOfADriveFallByItsGradient) {
  Trajectory line{"line", {}, {}};
  for (int i = 0; i <= 100; ++i) line.wheels.push_back({0.02 * i, 0.01 * i, 0.01 * i});
  PreparedRun run;
  run.source = &line;
  run.truth = {{0.5, 0, 0, 0}, {1.5, 0.5, 0.1, 0.3}};
  run.motion = {Motion::line, Motion::line};
  Unknowns u = Unknowns::Zero();
  u.head<3>() << 1, 1, 0.3;
  // Slip far below the tracker's noise, like it, and far above.
  for (const double K_m : {1e-9, 1e-6, 1e-4, 1e-3})
    for (const bool headings : {true, false}) {
      run.has_headings = headings;
      const NoiseModel noise{K_m, 1e-3, 3e-3};
      constexpr RobustMode kRobust = RobustMode::tracker_and_wheels;
      const InnovationSums sums = innovations(Moves(run, u), noise, kRobust);
      for (const int unknown : {kStartX, kStartY}) {
        constexpr double kStep_m = 1e-6;
        Unknowns up = u, down = u;
        up[unknown] += kStep_m;
        down[unknown] -= kStep_m;
        const double slope = (innovations(Moves(run, up), noise, kRobust).cost -
                              innovations(Moves(run, down), noise, kRobust).cost) /
                             (2 * kStep_m);
        // Before the first look nothing is uncertain, so no gain hides behind the derivative.
        EXPECT_NEAR(slope, -2 * sums.gradient[unknown], 1e-4 * (1 + std::abs(slope)))
            << K_m << ' ' << headings << ' ' << unknown;
      }
    }
}

}  // namespace
}  // namespace astro::calibration
