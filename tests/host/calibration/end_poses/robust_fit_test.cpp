#include "host/calibration/end_poses/robust_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "host/calibration/end_poses/compose.hpp"
#include "tests/host/calibration/end_poses/slipping_squares.hpp"

namespace astro::calibration {
namespace {

using namespace test;

constexpr Options kRobust{Method::robust};

TEST(EndScatter, IsThatOfSquaresWhoseWheelsSlip) {
  constexpr int kRuns = 4000;
  for (const Sense sense : {Sense::cw, Sense::ccw}) {
    SlippingRobot robot(11);
    const EndPose centre = replay_square(kSide_m, sense, kNominal, kNominal);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int i = 0; i < kRuns; ++i) {
      const EndPose end = robot.square(sense, kNominal, kNominal);
      const Eigen::Vector3d off(end.x_m - centre.x_m, end.y_m - centre.y_m, end.theta_rad - centre.theta_rad);
      sum += off * off.transpose() / kRuns;
    }
    const Eigen::Matrix3d expected = end_covariance(kSide_m, sense, kNominal.b_m);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3;
           ++k)  // a covariance of 4000 runs is known to 1.6 to 2.2 % of the deviations' product
        EXPECT_NEAR(sum(i, k), expected(i, k), 0.08 * std::sqrt(expected(i, i) * expected(k, k)))
            << name_of(sense) << ' ' << i << ' ' << k;
  }
}

TEST(RobustFit, GivesNoiseFreeRobotsBackWhateverHeadingsWereMeasured) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    const double E_d = uniform(random, 0.99, 1.01), E_b = uniform(random, 0.95, 1.05);
    const WheelFactors loaded{uniform(random, 0.98, 1.02), uniform(random, 0.98, 1.02),
                              uniform(random, 0.2, 0.4)};
    Runs runs = drive(kSide_m, loaded, compose(loaded, E_d, E_b));
    if (i % 3 > 0) runs.cw[0].theta_rad = kNotMeasured;
    if (i % 3 > 1) runs.ccw[0].theta_rad = kNotMeasured;
    const Estimate e = calibrate(runs, loaded, kRobust);
    EXPECT_NEAR(e.E_d, E_d, 1e-8) << "run " << i;
    EXPECT_NEAR(e.E_b, E_b, 1e-8) << "run " << i;
  }
}

TEST(RobustFit, RefusesNoHonestRunsHoweverFarTwoOfThemAreApart) {
  constexpr int kExperiments = 1000;
  SlippingRobot robot(13, {.slip_m = 6 * EndNoise{}.slip_m});
  for (int i = 0; i < kExperiments; ++i) {
    Runs runs = robot.squares(2);
    for (int k = 0; k < 2; ++k) runs.cw[k].theta_rad = runs.ccw[k].theta_rad = kNotMeasured;
    EXPECT_NO_THROW(fit_ends(runs.cw, runs.ccw, {kSide_m, kNominal})) << "experiment " << i;
  }
}

/// Root mean squares of the errors of ln E_d and ln E_b over experiments of 5 and 5 squares.
struct Spread {
  double E_d = 0, E_b = 0;
  void add(const Estimate& e, int experiments) {
    E_d += std::pow(std::log(e.E_d / kThesis_E_d), 2) / experiments;
    E_b += std::pow(std::log(e.E_b / kThesis_E_b), 2) / experiments;
  }
};

TEST(RobustFit, CostsFewPercentOfPrecisionWhereNothingIsWrong) {
  constexpr int kExperiments = 400;
  SlippingRobot robot(5);
  Spread robust, extended, positions;
  for (int i = 0; i < kExperiments; ++i) {
    const Runs runs = robot.squares(5);
    robust.add(calibrate(runs, kNominal, kRobust), kExperiments);
    extended.add(calibrate(runs, kNominal, {Method::extended}), kExperiments);
    positions.add(calibrate(runs, kNominal, {Method::least_squares}), kExperiments);
  }
  std::printf("rms of E_d, E_b in 1e-4: robust %.2f %.2f, extended %.2f %.2f, least squares %.2f %.2f\n",
              1e4 * std::sqrt(robust.E_d), 1e4 * std::sqrt(robust.E_b), 1e4 * std::sqrt(extended.E_d),
              1e4 * std::sqrt(extended.E_b), 1e4 * std::sqrt(positions.E_d), 1e4 * std::sqrt(positions.E_b));
  // 4 % by its design, and the ratio of two rms over the same drives scatters by 1 to 2 %.
  EXPECT_LT(robust.E_d, std::pow(1.08, 2) * std::min(extended.E_d, positions.E_d));
  EXPECT_LT(robust.E_b, std::pow(1.08, 2) * std::min(extended.E_b, positions.E_b));
}

TEST(RobustFit, KnowsHowFarItIsOff) {
  constexpr int kExperiments = 400;
  for (const bool headings : {true, false}) {
    SlippingRobot robot(6);
    Eigen::Vector2d squares(0, 0), claimed(0, 0);
    for (int i = 0; i < kExperiments; ++i) {
      Runs runs = robot.squares(5);
      for (int k = 0; k < 5 && !headings; ++k) runs.cw[k].theta_rad = runs.ccw[k].theta_rad = kNotMeasured;
      const RobustFit fit = fit_ends(runs.cw, runs.ccw, {kSide_m, kNominal});
      squares +=
          Eigen::Vector2d(std::log(fit.E_d / kThesis_E_d), std::log(fit.E_b / kThesis_E_b)).cwiseAbs2();
      claimed += fit.covariance.diagonal();
    }
    const Eigen::Vector2d ratio = squares.cwiseQuotient(claimed);
    std::printf("headings %d: squared errors of E_d, E_b over claimed variances: %.2f, %.2f\n", headings,
                ratio(0), ratio(1));
    for (const double one : ratio) EXPECT_NEAR(one, 1, 0.25) << "a mean of 400 squares scatters by 0.07";
  }
}

/// Unlike the mean of the claimed variances above, each error over its own standard error shows whether a single experiment
/// claims too much.
TEST(RobustFit, KnowsInEachExperimentHowFarItIsOffHoweverMuchTheRobotSlips) {
  constexpr int kExperiments = 500;
  for (const double slip_m : {1e-6, 3e-5})
    for (const int each : {3, 5})
      for (const bool headings : {true, false}) {
        SlippingRobot robot(10, {.slip_m = slip_m});
        double E_d = 0, E_b = 0;
        for (int i = 0; i < kExperiments; ++i) {
          Runs runs = robot.squares(each);
          for (std::vector<EndPose>* ends : {&runs.cw, &runs.ccw})
            for (EndPose& end : *ends)
              if (!headings) end.theta_rad = kNotMeasured;
          const Estimate found = calibrate(runs, kNominal, kRobust);
          E_d += std::pow((found.E_d - kThesis_E_d) / found.se.E_d, 2) / kExperiments;
          E_b += std::pow((found.E_b - kThesis_E_b) / found.se.E_b, 2) / kExperiments;
        }
        std::printf("slip %.2g m, %d each, headings %d: errors over standard errors %.2f, %.2f (rms)\n",
                    slip_m, each, headings, std::sqrt(E_d), std::sqrt(E_b));
        // An rms of 500 scatters by 4 %, and by more where three runs leave few numbers, so that errors have long tails. A robot
        // that slips less than usual has larger errors, because of the prior.
        for (const double one : {std::sqrt(E_d), std::sqrt(E_b)}) {
          EXPECT_LT(one, each == 3 ? 1.4 : 1.25);
          EXPECT_GT(one, 0.65);
        }
      }
}

/// What a person makes of an honest end.
struct Slip {
  const char* name;
  std::function<void(EndPose&)> spoil;
};

const std::vector<Slip> kSlips{
    {"x ten times", [](EndPose& end) { end.x_m *= 10; }},
    {"y ten times", [](EndPose& end) { end.y_m *= 10; }},
    {"x a tenth", [](EndPose& end) { end.x_m *= 0.1; }},
    {"y a tenth", [](EndPose& end) { end.y_m *= 0.1; }},
    {"lengths in mm",
     [](EndPose& end) {
       end = {1000 * end.x_m, 1000 * end.y_m, end.theta_rad};
     }},
    {"sign of x", [](EndPose& end) { end.x_m = -end.x_m; }},
    {"sign of y", [](EndPose& end) { end.y_m = -end.y_m; }},
    {"sign of the heading", [](EndPose& end) { end.theta_rad = -end.theta_rad; }},
    {"x and y exchanged", [](EndPose& end) { std::swap(end.x_m, end.y_m); }},
    {"no heading", [](EndPose& end) { end.theta_rad = kNotMeasured; }},
    {"degrees for radians", [](EndPose& end) { end.theta_rad *= std::numbers::pi / 180; }},
};

/// The larger of the changes of E_d and E_b by a mistake, in standard errors of the experiment without it.
double moved_by(const Estimate& without, const Estimate& with) {
  return std::max(std::abs(with.E_d - without.E_d) / without.se.E_d,
                  std::abs(with.E_b - without.E_b) / without.se.E_b);
}

TEST(RobustFit, IsMovedByNoMistakeInWhicheverRunByMoreThanTwoStandardErrors) {
  constexpr int kExperiments = 300;
  for (const Slip& slip : kSlips) {
    SlippingRobot robot(7);
    double most = 0, squares = 0;
    for (int i = 0; i < kExperiments; ++i) {
      const Runs runs = robot.squares(5);
      Runs spoilt = runs;
      slip.spoil(i % 2 == 0 ? spoilt.cw[i / 2 % 5] : spoilt.ccw[i / 2 % 5]);
      const double moved = moved_by(calibrate(runs, kNominal, kRobust), calibrate(spoilt, kNominal, kRobust));
      most = std::max(most, moved);
      squares += moved * moved / kExperiments;
    }
    std::printf("%-20s moves by %.2f standard errors (rms), %.2f at most\n", slip.name, std::sqrt(squares),
                most);
    EXPECT_LT(most, 2) << slip.name;
  }
}

TEST(RobustFit, IsMovedLittleByFourMistakesInDifferentRuns) {
  constexpr int kExperiments = 300;
  SlippingRobot robot(8);
  double most = 0, squares = 0;
  int far = 0;
  for (int i = 0; i < kExperiments; ++i) {
    const Runs runs = robot.squares(5);
    Runs spoilt = runs;
    kSlips[0].spoil(spoilt.cw[0]);
    kSlips[4].spoil(spoilt.ccw[1]);
    kSlips[6].spoil(spoilt.cw[3]);
    kSlips[9].spoil(spoilt.ccw[4]);
    const double moved = moved_by(calibrate(runs, kNominal, kRobust), calibrate(spoilt, kNominal, kRobust));
    most = std::max(most, moved);
    squares += moved * moved;
    far += moved > 2 ? 1 : 0;
  }
  const double rms = std::sqrt(squares / kExperiments);
  std::printf(
      "four mistakes move by %.2f standard errors (rms), %.2f at most, by more than 2 in %d of %d "
      "experiments\n",
      rms, most, far, kExperiments);
  // Three runs of ten are lost, and the loss of their honest ends alone moves each of two factors by 0.65 standard errors
  // (rms), the one that moves more by 0.8. The wrong ends may add half of that, and nobody was asked here.
  EXPECT_LT(rms, 1.2);
  EXPECT_LE(far, kExperiments / 20);
}

}  // namespace
}  // namespace astro::calibration
