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
/// With e among the unknowns.
constexpr FixedParameters kAllFree{.e = false};
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

/// Where an unknown of a run is in the dense matrix.
int place(int run, int unknown) { return unknown < kShared ? unknown : unknown + run * kOwn; }

struct Dense {
  Matrix information = Matrix::Zero(kAll, kAll);
  Vector gradient = Vector::Zero(kAll);
};

Dense dense(const std::vector<InnovationSums>& sums) {
  Dense all;
  for (int run = 0; run < kRuns; ++run)
    for (int i = 0; i < kUnknowns; ++i) {
      const InnovationSums& one = sums[static_cast<std::size_t>(run)];
      all.gradient[place(run, i)] += one.gradient[i];
      for (int k = 0; k < kUnknowns; ++k)
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
    for (int i = 0; i < kUnknowns; ++i)
      // The priors, of 1e-2 to 2.5e3, weigh 1e-6 of the observations' 1e9.
      EXPECT_NEAR(steps[static_cast<std::size_t>(run)][i], expected[place(run, i)], 1e-5) << run << ' ' << i;
}

TEST(NormalEquations, OfTheStretchesOfARunAddUpToThoseOfTheRun) {
  const std::vector<InnovationSums> stretches = random_sums();
  InnovationSums whole;
  for (const InnovationSums& stretch : stretches) {
    whole.information += stretch.information;
    whole.gradient += stretch.gradient;
  }
  const Reduced expected = reduced(whole, kAllFree, 0);
  Reduced sum{SharedInformation::Zero(), SharedVector::Zero()};
  for (const Reduced& stretch : reduced(whole, stretches, kAllFree)) {
    sum.information += stretch.information;
    sum.gradient += stretch.gradient;
  }
  // Each counts the weak prior of the clock offset, 1e-2 beside 1e9.
  EXPECT_LT((sum.information - expected.information).norm(), 1e-9 * expected.information.norm());
  EXPECT_LT((sum.gradient - expected.gradient).norm(), 1e-9 * expected.gradient.norm());
}

TEST(NormalEquations, StepWhereOneDenseLeastSquaresWould) {
  const std::vector<InnovationSums> sums = random_sums();
  const Dense all = dense(sums);
  expect_steps(gauss_newton_step(sums, kAllFree, 0), all.information.ldlt().solve(all.gradient));
}

TEST(NormalEquations, StepLessFarWhenDamped) {
  const std::vector<InnovationSums> sums = random_sums();
  Dense all = dense(sums);
  all.information.diagonal() *= 1.5;
  expect_steps(gauss_newton_step(sums, kAllFree, 0.5), all.information.ldlt().solve(all.gradient));
}

TEST(NormalEquations, LeaveWhatIsHeldWhereItIs) {
  const std::vector<InnovationSums> sums = random_sums();
  FixedParameters fixed;
  fixed.factors = true;
  Dense some = held_out(dense(sums), {kCRight, kCLeft, kB, kE});
  expect_steps(gauss_newton_step(sums, fixed, 0), some.information.ldlt().solve(some.gradient));
  fixed = kAllFree;
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
  const Reduced found = reduced(run, kAllFree, 0);
  EXPECT_NEAR((found.information - schur).norm() / schur.norm(), 0, 1e-9);
  EXPECT_NEAR((found.gradient - left).norm() / left.norm(), 0, 1e-9);
}

TEST(NormalEquations, HaveTheCovarianceOfTheDenseInverse) {
  const std::vector<InnovationSums> sums = random_sums();
  const Matrix inverse = dense(sums).information.inverse();
  const SharedInformation covariance = pool_of(sums, kAllFree).covariance(0);
  const double size = inverse.topLeftCorner(kShared, kShared).norm();
  EXPECT_NEAR((covariance - inverse.topLeftCorner(kShared, kShared)).norm() / size, 0, 1e-5);
  for (int run = 0; run < kRuns; ++run) {
    const int offset = place(run, kClockOffset);
    EXPECT_NEAR(clock_offset_variance(sums[static_cast<std::size_t>(run)], covariance, kAllFree),
                inverse(offset, offset), 1e-5 * inverse(offset, offset));
  }
}

TEST(NormalEquations, HaveTheDeterminantOfTheDenseMatrix) {
  const std::vector<InnovationSums> sums = random_sums();
  const double expected = dense(sums).information.ldlt().vectorD().array().log().sum();
  EXPECT_NEAR(log_determinant(sums, kAllFree), expected, 1e-5 * kAll);
}

/// The same runs, the last of which belongs to a session of its own.
std::vector<InnovationSums> two_sessions() {
  std::vector<InnovationSums> sums = random_sums();
  sums.back().session = 1;
  return sums;
}

/// Of them, with the unknowns of the second session behind all others.
Dense dense_of_two_sessions(const std::vector<InnovationSums>& sums) {
  Dense all{Matrix::Zero(kAll + kOfSession, kAll + kOfSession), Vector::Zero(kAll + kOfSession)};
  const auto at = [&](int run, int unknown) {
    const bool of_session = unknown >= kFactors && unknown < kShared;
    return of_session && sums[static_cast<std::size_t>(run)].session == 1 ? kAll + unknown - kFactors
                                                                          : place(run, unknown);
  };
  for (int run = 0; run < kRuns; ++run)
    for (int i = 0; i < kUnknowns; ++i) {
      const InnovationSums& one = sums[static_cast<std::size_t>(run)];
      all.gradient[at(run, i)] += one.gradient[i];
      for (int k = 0; k < kUnknowns; ++k) all.information(at(run, i), at(run, k)) += one.information(i, k);
    }
  return all;
}

TEST(NormalEquations, GiveEachSessionALeverArmAndASkewOfItsOwn) {
  const std::vector<InnovationSums> sums = two_sessions();
  const Dense all = dense_of_two_sessions(sums);
  const Vector expected = all.information.ldlt().solve(all.gradient);
  const std::vector<Unknowns> steps = gauss_newton_step(sums, kAllFree, 0);
  EXPECT_NEAR((steps[0].head<kShared>() - expected.head<kShared>()).norm(), 0, 1e-5);
  EXPECT_NEAR((steps[2].head<kFactors>() - expected.head<kFactors>()).norm(), 0, 1e-5);
  EXPECT_NEAR((steps[2].segment<kOfSession>(kFactors) - expected.tail<kOfSession>()).norm(), 0, 1e-5);
  const Matrix inverse = all.information.inverse();
  const SharedInformation covariance = pool_of(sums, kAllFree).covariance(1);
  const double size = covariance.norm();
  EXPECT_NEAR((covariance.bottomRightCorner<kOfSession, kOfSession>() -
               inverse.bottomRightCorner(kOfSession, kOfSession))
                      .norm() /
                  size,
              0, 1e-5);
  EXPECT_NEAR((covariance.topRightCorner<kFactors, kOfSession>() -
               inverse.topRightCorner(kAll + kOfSession, kOfSession).topRows(kFactors))
                      .norm() /
                  size,
              0, 1e-5);
  const double expected_determinant = all.information.ldlt().vectorD().array().log().sum();
  EXPECT_NEAR(log_determinant(sums, kAllFree), expected_determinant, 1e-5 * kAll);
}

TEST(NormalEquations, ForgetARunThatIsTakenOut) {
  const std::vector<InnovationSums> sums = two_sessions();
  Pool pool = pool_of(sums, kAllFree);
  pool.take_out(reduced(sums[1], kAllFree, 0));
  const Pool others = pool_of(std::vector{sums[0], sums[2]}, kAllFree);
  EXPECT_NEAR((pool.factor_step() - others.factor_step()).norm() / others.factor_step().norm(), 0, 1e-6);
}

TEST(NormalEquations, KeepEAtZeroWhereItIsNotEstimated) {
  const Pool pool = pool_of(random_sums(), {});
  EXPECT_EQ(pool.factor_step()[kE], 0);
  EXPECT_EQ(pool.factor_covariance().row(kE).norm(), 0);
}

TEST(NormalEquations, PullOnAnEThatNoRunShows) {
  const Pool pool = pool_of({}, kAllFree, {.e = 0.04});
  EXPECT_DOUBLE_EQ(pool.factor_step()[kE], -0.04);
  EXPECT_DOUBLE_EQ(pool.factor_covariance()(kE, kE), 4e-4);  // 2 %
}

TEST(NormalEquations, LeaveThePriorOfEAsWideAsItIsWhenErrorsAreWidened) {
  constexpr double kWidening = 2.5;
  std::vector<InnovationSums> sums = random_sums();
  for (InnovationSums& run : sums) {  // so little is said of e that the prior counts as much
    run.information.row(kE).setZero();
    run.information.col(kE).setZero();
    run.information(kE, kE) = 1000;
  }
  const double of_runs = 1000.0 * kRuns / kWidening, of_prior = 2500;
  const Pool pool = pool_of(sums, kAllFree, {.weight = kWidening});
  EXPECT_NEAR(kWidening * pool.factor_covariance()(kE, kE), 1 / (of_runs + of_prior), 1e-9);
}

TEST(NormalEquations, KeepAWideErrorForWhatNoRunShows) {
  Reduced nothing{SharedInformation::Zero(), SharedVector::Zero()};
  nothing.information.diagonal().head<3>().setConstant(1e6);
  Pool pool({});
  pool.add(nothing);
  const SharedInformation covariance = pool.covariance(0);
  EXPECT_NEAR(covariance(kCRight, kCRight), 1e-6, 1e-12);
  EXPECT_DOUBLE_EQ(covariance(kLeverX, kLeverX), 1);  // a metre
  EXPECT_DOUBLE_EQ(covariance(kSkew, kSkew), 0.01);   // 10 %
}

}  // namespace
}  // namespace astro::calibration
