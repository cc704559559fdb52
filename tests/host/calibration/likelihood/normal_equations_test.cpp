#include "host/calibration/likelihood/normal_equations.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdio>
#include <random>

// Against one dense matrix of all unknowns of all runs, in which nothing is eliminated.
namespace astro::calibration {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr unsigned kSeed = 5;
constexpr int kRuns = 3, kAll = kShared + kRuns * kOwn;

/// Sums as so many random observations of each run would leave them, strong enough to hide the weak priors.
std::vector<InnovationSums> random_sums() {
  std::printf("seed %u\n", kSeed);
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal(0, 1e4);
  std::vector<InnovationSums> sums(kRuns);
  for (InnovationSums& run : sums)
    for (int i = 0; i < 40; ++i) {
      Unknowns j;
      for (double& value : j) value = normal(random);
      run.information += j * j.transpose();
      run.gradient += j * normal(random);
    }
  return sums;
}

/// Where an unknown of a run is in the dense matrix; the arcs' wheelbase is not.
int place(int run, int unknown) { return unknown < kShared ? unknown : unknown + run * kOwn; }

struct Dense {
  Matrix information = Matrix::Zero(kAll, kAll);
  Vector gradient = Vector::Zero(kAll);
};

Dense dense(const std::vector<InnovationSums>& sums) {
  Dense all;
  for (int run = 0; run < kRuns; ++run)
    for (int i = 0; i <= kClockOffset; ++i) {
      const InnovationSums& one = sums[static_cast<std::size_t>(run)];
      all.gradient[place(run, i)] += one.gradient[i];
      for (int k = 0; k <= kClockOffset; ++k)
        all.information(place(run, i), place(run, k)) += one.information(i, k);
    }
  return all;
}

/// Without these rows and columns.
Dense held_out(Dense all, std::initializer_list<int> unknowns) {
  for (const int unknown : unknowns) {
    all.information.row(unknown).setZero();
    all.information.col(unknown).setZero();
    all.information(unknown, unknown) = 1;
    all.gradient[unknown] = 0;
  }
  return all;
}

void expect_steps(const std::vector<Unknowns>& steps, const Vector& expected) {
  ASSERT_EQ(steps.size(), static_cast<std::size_t>(kRuns));
  for (int run = 0; run < kRuns; ++run)
    for (int i = 0; i <= kClockOffset; ++i)
      // The priors, of 1e-2 to 1e2, weigh 1e-7 of the observations' 1e9.
      EXPECT_NEAR(steps[static_cast<std::size_t>(run)][i], expected[place(run, i)], 1e-5) << run << ' ' << i;
}

TEST(NormalEquations, StepWhereOneDenseLeastSquaresWould) {
  const std::vector<InnovationSums> sums = random_sums();
  const Dense all = dense(sums);
  expect_steps(gauss_newton_step(sums, {}, 0), all.information.ldlt().solve(all.gradient));
}

TEST(NormalEquations, StepLessFarWhenDamped) {
  const std::vector<InnovationSums> sums = random_sums();
  Dense all = dense(sums);
  all.information.diagonal() *= 1.5;
  expect_steps(gauss_newton_step(sums, {}, 0.5), all.information.ldlt().solve(all.gradient));
}

TEST(NormalEquations, LeaveWhatIsHeldWhereItIs) {
  const std::vector<InnovationSums> sums = random_sums();
  FixedParameters fixed;
  fixed.factors = true;
  Dense some = held_out(dense(sums), {kCRight, kCLeft, kB});
  expect_steps(gauss_newton_step(sums, fixed, 0), some.information.ldlt().solve(some.gradient));
  fixed = {};
  fixed.clock = fixed.lever_yaw = true;
  some = held_out(dense(sums),
                  {kLeverYaw, kSkew, place(0, kClockOffset), place(1, kClockOffset), place(2, kClockOffset)});
  expect_steps(gauss_newton_step(sums, fixed, 0), some.information.ldlt().solve(some.gradient));
}

TEST(NormalEquations, ReduceARunToItsSchurComplement) {
  const InnovationSums run = random_sums().front();
  const Matrix a = run.information;
  const Matrix own = a.block(kShared, kShared, kOwn, kOwn), mixed = a.block(0, kShared, kShared, kOwn);
  const Matrix schur = a.topLeftCorner(kShared, kShared) - mixed * own.inverse() * mixed.transpose();
  const Vector left =
      run.gradient.head(kShared) - mixed * own.inverse() * run.gradient.segment(kShared, kOwn);
  const Reduced found = reduced(run, {}, 0);
  EXPECT_NEAR((found.information - schur).norm() / schur.norm(), 0, 1e-9);
  EXPECT_NEAR((found.gradient - left).norm() / left.norm(), 0, 1e-9);
}

TEST(NormalEquations, HaveTheCovarianceOfTheDenseInverse) {
  const std::vector<InnovationSums> sums = random_sums();
  const Matrix inverse = dense(sums).information.inverse();
  SharedInformation information = SharedInformation::Zero();
  for (const InnovationSums& run : sums) information += reduced(run, {}, 0).information;
  const SharedInformation covariance = shared_covariance(information, {});
  const double size = inverse.topLeftCorner(kShared, kShared).norm();
  EXPECT_NEAR((covariance - inverse.topLeftCorner(kShared, kShared)).norm() / size, 0, 1e-5);
  for (int run = 0; run < kRuns; ++run) {
    const int offset = place(run, kClockOffset);
    EXPECT_NEAR(clock_offset_variance(sums[static_cast<std::size_t>(run)], covariance, {}),
                inverse(offset, offset), 1e-5 * inverse(offset, offset));
  }
}

TEST(NormalEquations, HaveTheDeterminantOfTheDenseMatrix) {
  const std::vector<InnovationSums> sums = random_sums();
  const double expected = dense(sums).information.ldlt().vectorD().array().log().sum();
  EXPECT_NEAR(log_determinant(sums, {}), expected, 1e-5 * kAll);
}

TEST(NormalEquations, LetOneMoreUnknownMoveAsIfItHadBeenThereAllAlong) {
  const std::vector<InnovationSums> sums = random_sums();
  const Dense all = dense(sums);
  Matrix wider = Matrix::Zero(kAll + 1, kAll + 1);
  Vector gradient(kAll + 1);
  wider.topLeftCorner(kAll, kAll) = all.information;
  gradient << all.gradient, 0;
  for (int run = 0; run < kRuns; ++run) {
    const InnovationSums& one = sums[static_cast<std::size_t>(run)];
    wider(kAll, kAll) += one.information(kArcWheelbase, kArcWheelbase);
    gradient[kAll] += one.gradient[kArcWheelbase];
    for (int i = 0; i <= kClockOffset; ++i) {
      wider(place(run, i), kAll) += one.information(i, kArcWheelbase);
      wider(kAll, place(run, i)) += one.information(i, kArcWheelbase);
    }
  }
  const OneUnknown found = arc_wheelbase(sums, {});
  const double variance = wider.inverse()(kAll, kAll);
  EXPECT_NEAR(found.value, wider.ldlt().solve(gradient)[kAll], 1e-5);
  EXPECT_NEAR(found.standard_error, std::sqrt(variance), 1e-5 * std::sqrt(variance));
}

TEST(NormalEquations, KeepAWideErrorForWhatNoRunShows) {
  SharedInformation nothing = SharedInformation::Zero();
  nothing.diagonal().head<3>().setConstant(1e6);
  const SharedInformation covariance = shared_covariance(nothing, {});
  EXPECT_NEAR(covariance(kCRight, kCRight), 1e-6, 1e-12);
  EXPECT_DOUBLE_EQ(covariance(kLeverX, kLeverX), 1);  // a metre
  EXPECT_DOUBLE_EQ(covariance(kSkew, kSkew), 0.01);   // 10 %
}

}  // namespace
}  // namespace astro::calibration
