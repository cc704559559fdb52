#include "host/calibration/end_poses/umbmark.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "host/calibration/end_poses/compose.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "tests/host/calibration/end_poses/square_runs.hpp"

namespace astro::calibration {
namespace {

using namespace test;

constexpr unsigned kSeed = 20240611;
constexpr Options kExact{Method::extended, AngleSource::average, Formula::exact};
constexpr Options kPublished{Method::extended, AngleSource::average, Formula::published};
constexpr Options kFit{Method::least_squares};
constexpr Options kRobust{Method::robust};

Options umbmark(AngleSource angles) { return {Method::umbmark, angles}; }

/// What is left of the systematic error after one noise-free calibration of a nominal robot.
double residual_m(const Options& options) {
  const Estimate e = calibrate(drive(kSide_m, kNominal, kThesisRobot), kNominal, options);
  return replay_E_max_syst_m(kSide_m, e.factors, kThesisRobot);
}

TEST(Compose, ANominalRobotGetsThePairWhoseRatioIsEd) {
  const WheelFactors f = compose(kNominal, 1.00416, 0.99521);
  EXPECT_NEAR(f.c_r, 2 * 1.00416 / 2.00416, 1e-15);
  EXPECT_NEAR(f.c_l, 2 / 2.00416, 1e-15);
  EXPECT_NEAR(f.b_m, 0.99521 * 0.290, 1e-15);
}

TEST(Compose, RatiosMultiplyAndTheSumStays) {
  const WheelFactors loaded{1.013, 1.007, 0.285};
  const WheelFactors f = compose(loaded, 0.998, 1.003);
  EXPECT_NEAR(f.c_r / f.c_l, 0.998 * 1.013 / 1.007, 1e-15);
  EXPECT_NEAR(f.c_r + f.c_l, 2.020, 1e-15);
  EXPECT_NEAR(f.b_m, 1.003 * 0.285, 1e-15);
}

TEST(Extended, ExactFormulaGivesAnyNoiseFreeRobotBack) {
  std::mt19937_64 random(kSeed);
  std::printf("seed %u\n", kSeed);
  for (int i = 0; i < 1000; ++i) {
    const double side_m = uniform(random, 0.5, 10);
    const WheelFactors nominal{1, 1, uniform(random, 0.05, 1)};
    // Legs that turn by up to 0.3 rad and spins that miss by up to 10 %: the end heading stays within half a
    // turn.
    const double h = uniform(random, -0.3, 0.3) * nominal.b_m / (2 * side_m);
    const double E_d = (1 + h) / (1 - h), E_b = uniform(random, 0.9, 1.1);
    const Runs runs = drive(side_m, nominal, compose(nominal, E_d, E_b));
    const Estimate e = calibrate(runs, nominal, kExact, side_m);
    EXPECT_NEAR(e.E_d, E_d, 1e-9) << "run " << i;
    EXPECT_NEAR(e.E_b, E_b, 1e-9) << "run " << i;
  }
}

TEST(Extended, OnARobotThatCarriesFactorsEdIsExactAndTheWheelbaseToSecondOrder) {
  std::mt19937_64 random(kSeed);
  std::printf("seed %u\n", kSeed);
  for (int i = 0; i < 1000; ++i) {
    const WheelFactors loaded{uniform(random, 0.98, 1.02), uniform(random, 0.98, 1.02),
                              uniform(random, 0.2, 0.4)};
    const double E_d = uniform(random, 0.99, 1.01), E_b = uniform(random, 0.95, 1.05);
    const WheelFactors truth = compose(loaded, E_d, E_b);
    const Estimate e = calibrate(drive(kSide_m, loaded, truth), loaded, kExact);
    EXPECT_NEAR(e.E_d, E_d, 1e-9) << "run " << i;
    // The sum c_R + c_L is kept, and with unequal loaded factors the mean of their two changes is not 1.
    const double mean_change = (truth.c_r / loaded.c_r + truth.c_l / loaded.c_l) / 2;
    EXPECT_NEAR(e.E_b, E_b / mean_change, 1e-9) << "run " << i;
    EXPECT_NEAR(mean_change, 1, 0.02 * 0.01) << "run " << i;  // |c_R - c_L| / 2 times |E_d - 1|, at most
  }
}

TEST(Extended, AlphaEdOfThePublishedFormulaBiasesTheWheelbaseByHalfOfEd) {
  const Estimate e = calibrate(drive(kSide_m, kNominal, kThesisRobot), kNominal, kPublished);
  // (E_d - 1) / 2 to first order; the second order is of the size of E_d - 1 times 1 - E_b.
  EXPECT_NEAR(e.E_b - kThesis_E_b, (kThesis_E_d - 1) / 2, 3e-5);
  EXPECT_NEAR(residual_m(kPublished), 0.028, 0.0005);  // half the last printed millimetre
  EXPECT_LT(residual_m(kExact), 1e-9);
}

TEST(LeastSquares, GivesNoiseFreeRobotsBackFromPositionsAlone) {
  std::mt19937_64 random(kSeed);
  std::printf("seed %u\n", kSeed);
  for (int i = 0; i < 300; ++i) {
    const double E_d = uniform(random, 0.99, 1.01), E_b = uniform(random, 0.95, 1.05);
    const WheelFactors loaded{uniform(random, 0.98, 1.02), uniform(random, 0.98, 1.02),
                              uniform(random, 0.2, 0.4)};
    Runs runs = drive(kSide_m, loaded, compose(loaded, E_d, E_b));
    runs.cw[0].theta_rad = runs.ccw[0].theta_rad = std::nan("");
    const Estimate e = calibrate(runs, loaded, kFit);
    EXPECT_NEAR(e.E_d, E_d, 1e-9) << "run " << i;
    EXPECT_NEAR(e.E_b, E_b, 1e-9) << "run " << i;
  }
}

TEST(LeastSquares, WeighsTheDirectionsByTheirRuns) {
  Runs runs = drive(kSide_m, kNominal, kThesisRobot);
  runs.ccw[0].x_m += 0.02;  // the two directions no longer agree
  Runs doubled = runs;
  doubled.ccw.push_back(runs.ccw[0]);
  doubled.cw.push_back(runs.cw[0]);
  Runs more_cw = runs;
  for (int i = 0; i < 99; ++i) more_cw.cw.push_back(runs.cw[0]);
  const double even = calibrate(runs, kNominal, kFit).E_b;
  EXPECT_NEAR(calibrate(doubled, kNominal, kFit).E_b, even, 1e-12);
  EXPECT_LT(std::abs(calibrate(more_cw, kNominal, kFit).E_b - kThesis_E_b), std::abs(even - kThesis_E_b));
}

TEST(Umbmark, SmallAngleResidualsAreThePublishedOnes) {
  EXPECT_NEAR(residual_m(umbmark(AngleSource::x)), 0.029, 0.0005);  // half the last printed digit
  EXPECT_NEAR(residual_m(umbmark(AngleSource::y)), 0.052, 0.0005);
  EXPECT_NEAR(residual_m(umbmark(AngleSource::thesis)), 0.035, 0.0005);
  EXPECT_NEAR(residual_m(umbmark(AngleSource::average)), 0.0115, 0.00005);
  EXPECT_LT(residual_m(kFit), 1e-9);
}

TEST(Umbmark, ASecondRoundComposesAndLeavesLessThan0Point7Millimetres) {
  for (const AngleSource angles :
       {AngleSource::x, AngleSource::y, AngleSource::thesis, AngleSource::average}) {
    SCOPED_TRACE(name_of(angles));
    WheelFactors loaded = kNominal;
    double left_m = replay_E_max_syst_m(kSide_m, loaded, kThesisRobot);
    for (int round = 1; round <= 2; ++round) {
      loaded = calibrate(drive(kSide_m, loaded, kThesisRobot), loaded, umbmark(angles)).factors;
      const double now_m = replay_E_max_syst_m(kSide_m, loaded, kThesisRobot);
      EXPECT_LT(now_m, left_m / 5);
      left_m = now_m;
    }
    EXPECT_LT(left_m, 0.0007);
  }
}

TEST(Umbmark, ReplacingInsteadOfComposingUndoesTheFirstRound) {
  const Options average = umbmark(AngleSource::average);
  const WheelFactors first = calibrate(drive(kSide_m, kNominal, kThesisRobot), kNominal, average).factors;
  const Runs second = drive(kSide_m, first, kThesisRobot);
  const WheelFactors replaced = calibrate(second, kNominal, average).factors;
  EXPECT_GT(replay_E_max_syst_m(kSide_m, replaced, kThesisRobot), 0.3);
}

TEST(EveryMethod, LeavesARobotThatNeedsNothingAlone) {
  for (const Options& options : {umbmark(AngleSource::average), kExact, kPublished, kFit, kRobust}) {
    SCOPED_TRACE(name_of(options.method));
    const Estimate e = calibrate({{{0, 0, 0}}, {{0, 0, 0}}}, kThesisRobot, options);
    EXPECT_NEAR(e.E_d, 1, 1e-12);
    EXPECT_NEAR(e.E_b, 1, 1e-12);
    EXPECT_NEAR(e.factors.c_r, kThesisRobot.c_r, 1e-12);
    EXPECT_NEAR(e.factors.c_l, kThesisRobot.c_l, 1e-12);
    EXPECT_NEAR(e.factors.b_m, kThesisRobot.b_m, 1e-12);
  }
}

TEST(EveryMethod, StraightLegsHaveAnInfiniteRadius) {
  for (const Options& options : {umbmark(AngleSource::average), kExact, kPublished}) {
    const Estimate e = calibrate({{{0.1, 0.1, 0.05}}, {{0.1, -0.1, -0.05}}}, kNominal, options);
    EXPECT_EQ(e.beta_rad, 0);
    EXPECT_TRUE(std::isinf(e.radius_m));
    EXPECT_EQ(e.E_d, 1);
    EXPECT_NE(e.E_b, 1);
  }
}

TEST(EveryMethod, RadiusIsPositiveWhenTheLegsCurveLeft) {
  const WheelFactors curves_right{kThesisRobot.c_l, kThesisRobot.c_r, kThesisRobot.b_m};
  for (const Options& options : {umbmark(AngleSource::average), kExact, kPublished, kFit, kRobust}) {
    EXPECT_GT(calibrate(drive(kSide_m, kNominal, kThesisRobot), kNominal, options).radius_m, 0);
    EXPECT_LT(calibrate(drive(kSide_m, kNominal, curves_right), kNominal, options).radius_m, 0);
  }
}

TEST(EveryMethod, MirroredRunsGiveTheMirroredRobot) {
  const Runs runs{{{-0.27, -0.38, 0.187}, {-0.19, -0.16, 0.122}},
                  {{0.30, -0.23, 0.160}, {0.41, -0.31, 0.206}}};
  const auto mirrored = [](std::vector<EndPose> poses) {
    for (EndPose& pose : poses) pose = {pose.x_m, -pose.y_m, -pose.theta_rad};
    return poses;
  };
  const Runs mirror{mirrored(runs.ccw), mirrored(runs.cw)};
  // All but Formula::published, whose bias of the wheelbase changes its sign with the larger wheel.
  for (const Options& options :
       {umbmark(AngleSource::x), umbmark(AngleSource::y), umbmark(AngleSource::thesis),
        umbmark(AngleSource::average), kExact, kFit, kRobust}) {
    const Estimate e = calibrate(runs, kNominal, options);
    const Estimate m = calibrate(mirror, kNominal, options);
    // The robust fit holds its scatter after some steps, before it has settled to the last digits.
    const double close = options.method == Method::robust ? 1e-8 : 1e-12;
    EXPECT_NEAR(m.alpha_rad, e.alpha_rad, close);
    EXPECT_NEAR(m.beta_rad, -e.beta_rad, close);
    EXPECT_NEAR(m.factors.c_r, e.factors.c_l, close);
    EXPECT_NEAR(m.factors.c_l, e.factors.c_r, close);
    EXPECT_NEAR(m.factors.b_m, e.factors.b_m, close);
    EXPECT_NEAR(m.se.b_m, e.se.b_m, std::max(close, 1e-8 * e.se.b_m));  // rounding of a central difference
    EXPECT_NEAR(m.se.c_r, e.se.c_l, std::max(close, 1e-8 * e.se.c_l));
  }
}

TEST(EveryMethod, IsReproducedInTheEstimate) {
  const Estimate e = calibrate(drive(kSide_m, kNominal, kThesisRobot), kNominal, kPublished);
  EXPECT_EQ(e.options.method, Method::extended);
  EXPECT_EQ(e.options.formula, Formula::published);
  EXPECT_EQ(e.side_m, kSide_m);
  EXPECT_EQ(e.loaded.b_m, kNominal.b_m);
  EXPECT_EQ(e.summary.cw.runs, 1);
  EXPECT_NEAR(e.summary.E_max_syst_m, 0.419, 0.0005);
}

TEST(EveryMethod, HasAName) {
  EXPECT_EQ(name_of(Method::umbmark), "umbmark");
  EXPECT_EQ(name_of(Method::extended), "extended");
  EXPECT_EQ(name_of(Method::least_squares), "least-squares");
  EXPECT_EQ(name_of(Method::robust), "robust");
  EXPECT_EQ(name_of(AngleSource::x), "x");
  EXPECT_EQ(name_of(AngleSource::y), "y");
  EXPECT_EQ(name_of(AngleSource::thesis), "thesis");
  EXPECT_EQ(name_of(AngleSource::average), "average");
  EXPECT_EQ(name_of(Formula::exact), "exact");
  EXPECT_EQ(name_of(Formula::published), "published");
}

}  // namespace
}  // namespace astro::calibration
