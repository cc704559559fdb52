#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>

#include "tests/host/calibration/end_poses/square_runs.hpp"

namespace astro::calibration {
namespace {

using namespace test;

constexpr unsigned kSeed = 271828;
constexpr int kExperiments = 2000;
constexpr int kRunsPerDirection = 5;

/// Normal scatter of the size of the thesis's, x, y and theta correlated as a heading error makes them.
std::vector<EndPose> scattered(const EndPose& centre, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<EndPose> out;
  for (int i = 0; i < kRunsPerDirection; ++i) {
    const double common = normal(random);
    out.push_back({centre.x_m + 0.05 * common + 0.02 * normal(random),
                   centre.y_m + 0.06 * common + 0.02 * normal(random),
                   centre.theta_rad + 0.02 * common + 0.01 * normal(random)});
  }
  return out;
}

/// Compares the variance of an estimate over many experiments with the mean of the variances that it claims.
class Tally {
 public:
  void add(double value, double claimed_se) {
    sum_ += value;
    squares_ += value * value;
    claimed_ += claimed_se * claimed_se;
  }
  double claimed_over_actual() const {
    const double mean = sum_ / kExperiments;
    return claimed_ / kExperiments / (squares_ / kExperiments - mean * mean);
  }

 private:
  double sum_ = 0, squares_ = 0, claimed_ = 0;
};

class StandardErrorsOf : public testing::TestWithParam<Options> {};

TEST_P(StandardErrorsOf, TheMethodAgreeWithAMonteCarlo) {
  std::mt19937_64 random(kSeed);
  std::printf("seed %u, %d experiments\n", kSeed, kExperiments);
  const Runs centre = drive(kSide_m, kNominal, kThesisRobot);
  Tally E_d, E_b, c_r, c_l, b;
  for (int i = 0; i < kExperiments; ++i) {
    const Runs runs{scattered(centre.cw[0], random), scattered(centre.ccw[0], random)};
    const Estimate e = calibrate(runs, kNominal, GetParam());
    E_d.add(e.E_d - 1, e.se.E_d);
    E_b.add(e.E_b - 1, e.se.E_b);
    c_r.add(e.factors.c_r - 1, e.se.c_r);
    c_l.add(e.factors.c_l - 1, e.se.c_l);
    b.add(e.factors.b_m - kNominal.b_m, e.se.b_m);
  }
  // A variance from N normal samples is known to sqrt(2 / N), the mean claim to sqrt(2 / (8 N)); four of
  // their sum. What curvature adds beyond the first order is (scatter / side)^2 < 1e-3 of the variance.
  const double bound = 4 * std::sqrt(2.0 / kExperiments * (1 + 1.0 / 8));
  for (const Tally* tally : {&E_d, &E_b, &c_r, &c_l, &b}) {
    EXPECT_NEAR(tally->claimed_over_actual(), 1, bound);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, StandardErrorsOf,
                         testing::Values(Options{Method::umbmark, AngleSource::x},
                                         Options{Method::umbmark, AngleSource::y},
                                         Options{Method::umbmark, AngleSource::thesis},
                                         Options{Method::umbmark, AngleSource::average},
                                         Options{Method::extended, AngleSource::average, Formula::exact},
                                         Options{Method::extended, AngleSource::average, Formula::published},
                                         Options{Method::least_squares}),
                         [](const auto& tested) {
                           const Options& o = tested.param;
                           if (o.method == Method::least_squares) return std::string("LeastSquares");
                           return o.method == Method::umbmark ? "umbmark_" + std::string(name_of(o.angles))
                                                              : "extended_" + std::string(name_of(o.formula));
                         });

TEST(StandardErrors, HaveTheirClosedFormForTheExtendedMethod) {
  // c_R - c_L = beta b / L to first order, and b = b_n / (1 - 2 alpha / pi): only theta matters.
  const std::vector<EndPose> cw{{0, 0, 0.01}, {0, 0, 0.03}}, ccw{{0, 0, -0.02}, {0, 0, 0.04}};
  const Estimate e = estimate_factors(cw, ccw, kSide_m, kNominal, {Method::extended});
  const double se_angle =
      std::hypot(0.01, 0.03) / 8;  // half the difference of two is the error of their mean
  const double se_b_m = 2 / std::numbers::pi * e.E_b * e.E_b * kNominal.b_m * se_angle;
  EXPECT_NEAR(e.se.b_m, se_b_m, 1e-8 * se_b_m);  // rounding of a central difference
  const double se_E_d = kNominal.b_m / kSide_m * se_angle;
  EXPECT_NEAR(e.se.E_d, se_E_d, 0.01 * se_E_d);  // first order: alpha and beta are below 0.01
}

TEST(StandardErrors, AreUnknownFromOneRun) {
  const std::vector<EndPose> one{{-0.2, -0.26, 0.15}}, two{{0.31, -0.26, 0.17}, {0.3, -0.25, 0.18}};
  for (const auto& [cw, ccw] : {Runs{one, two}, Runs{two, one}, Runs{one, one}}) {
    const Estimate e = estimate_factors(cw, ccw, kSide_m, kNominal);
    for (const double se : {e.se.E_d, e.se.E_b, e.se.c_r, e.se.c_l, e.se.b_m}) EXPECT_TRUE(std::isnan(se));
    EXPECT_TRUE(std::isfinite(e.factors.b_m));
  }
}

TEST(StandardErrors, ShrinkWithTheRootOfTheRuns) {
  const std::vector<EndPose> cw{{-0.2, -0.26, 0.15}, {-0.25, -0.2, 0.12}},
      ccw{{0.31, -0.26, 0.17}, {0.3, -0.2, 0.18}};
  auto more_cw = cw, more_ccw = ccw;
  for (int i = 1; i < 50; ++i) {
    more_cw.insert(more_cw.end(), cw.begin(), cw.end());
    more_ccw.insert(more_ccw.end(), ccw.begin(), ccw.end());
  }
  const StandardErrors few = estimate_factors(cw, ccw, kSide_m, kNominal).se;
  const StandardErrors many = estimate_factors(more_cw, more_ccw, kSide_m, kNominal).se;
  const double expected = std::sqrt(2.0 * 1 / (100.0 * 99) * 50);  // n (n - 1) and 50 times the squares
  EXPECT_NEAR(many.E_d / few.E_d, expected, 1e-6);
  EXPECT_NEAR(many.b_m / few.b_m, expected, 1e-6);
}

}  // namespace
}  // namespace astro::calibration
