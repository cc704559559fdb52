#include "host/calibration/likelihood/maximum_likelihood.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>
#include <random>

#include "host/calibration/judgement/remarks.hpp"
#include "host/calibration/likelihood/normal_equations.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation_problem.hpp"
#include "tests/host/calibration/ml_drives.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::calibration {
namespace {

using simulation::study::DriveModel;
using testing::IsEmpty;

/// The parameters in standard errors from the truth.
std::array<double, 3> misses(const MlEstimate& estimate, const WheelFactors& actual) {
  return {(estimate.factors.c_r - actual.c_r) / estimate.se.c_r,
          (estimate.factors.c_l - actual.c_l) / estimate.se.c_l,
          (estimate.factors.b_m - actual.b_m) / estimate.se.b_m};
}

// Beyond this a normal error lies once in 16,000.
constexpr double kFourSigma = 4;

void expect_true(const MlEstimate& estimate, const WheelFactors& actual) {
  for (const double miss : misses(estimate, actual)) EXPECT_LT(std::abs(miss), kFourSigma);
}

TEST(MaximumLikelihood, FindsTheTruthWhereThereIsNoNoise) {
  const DriveModel model = quiet_drive();
  const MlEstimate found = estimate_ml(squares(model, 2), model.loaded);
  // What is left: truth between the fine steps of the synthetic drive, and wheels between their samples.
  EXPECT_NEAR(found.factors.c_r, model.actual.c_r, 2e-6);
  EXPECT_NEAR(found.factors.c_l, model.actual.c_l, 2e-6);
  EXPECT_NEAR(found.factors.b_m, model.actual.b_m, 2e-6);
  EXPECT_NEAR(found.sessions[0].lever.x_m, model.lever.x_m, 1e-5);
  EXPECT_NEAR(found.sessions[0].lever.y_m, model.lever.y_m, 1e-5);
  EXPECT_NEAR(found.sessions[0].lever.theta_rad, model.lever.theta_rad, 1e-5);
}

TEST(MaximumLikelihood, ReachesTheCramerRaoBoundAndKnowsHowFarItIsOff) {
  const DriveModel model = astro_drive();
  constexpr int kTrials = 24;
  MlOptions given;
  given.noise = model.noise;
  const MlErrors bound =
      errors_of(cramer_rao_bound(squares(model, 4, 2), model.actual, model.lever, given), model.actual);
  double E_d = 0, scale = 0, b_over_scale = 0, chi_square = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const MlEstimate found = estimate_ml(
        squares(model, 4, 2, simulation::study::derived_seed(kSeed, static_cast<std::uint64_t>(trial))),
        model.loaded);
    const Eigen::Vector3d error(found.factors.c_r - model.actual.c_r, found.factors.c_l - model.actual.c_l,
                                found.factors.b_m - model.actual.b_m);
    const Eigen::Matrix3d covariance = found.covariance.topLeftCorner<3, 3>();
    chi_square += error.dot(covariance.ldlt().solve(error)) / kTrials;
    const double S = (model.actual.c_r + model.actual.c_l) / 2;
    E_d += std::pow((found.E_d() - 1.00416) / bound.E_d, 2) / kTrials;
    scale += std::pow((found.scale() - S) / bound.scale, 2) / kTrials;
    b_over_scale +=
        std::pow((found.factors.b_m / found.scale() - model.actual.b_m / S) / bound.b_over_scale_m, 2) /
        kTrials;
  }
  std::printf("of the bound, 24 trials: E_d %.2f, S %.2f, b/S %.2f; chi-square %.2f of 3\n", std::sqrt(E_d),
              std::sqrt(scale), std::sqrt(b_over_scale), chi_square);
  // A ratio of 1 shows up as 1 +- 1 / sqrt(2 trials); the figures with all digits are `astrolabe study`'s.
  for (const double ratio : {E_d, scale, b_over_scale})
    EXPECT_LT(std::sqrt(ratio), 1.1 + 3 / std::sqrt(2.0 * kTrials));
  // Chi-square of 3 has a standard deviation of sqrt(6).
  EXPECT_NEAR(chi_square, 3, 3 * std::sqrt(6.0 / kTrials));
}

TEST(MaximumLikelihood, DoesNotClaimMoreThanItKnowsOfARobotThatHardlySlips) {
  DriveModel model = astro_drive();
  model.noise.K_m = 1e-9;  // far below what two small squares can tell from none
  constexpr int kTrials = 12;
  double chi_square = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const MlEstimate found = estimate_ml(
        squares(model, 2, 1, simulation::study::derived_seed(kSeed, static_cast<std::uint64_t>(trial))),
        model.loaded);
    for (const double miss : misses(found, model.actual)) chi_square += miss * miss / kTrials;
  }
  std::printf("squares of the errors, in standard errors: %.2f of 3\n", chi_square);
  EXPECT_LT(chi_square, 3 + 3 * std::sqrt(6.0 / kTrials));
}

/// The readings of wheels whose encoders, gears or rims are out of round: over a turn they stray and come
/// back.
std::vector<Trajectory> out_of_round(std::vector<Trajectory> runs, double amplitude_m) {
  constexpr double kRadius_m = 0.042;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (WheelSample& wheels : runs[i].wheels) {
      const auto phase = static_cast<double>(i);  // nobody puts them down alike
      wheels.left_m += amplitude_m * std::sin(wheels.left_m / kRadius_m + phase);
      wheels.right_m += amplitude_m * std::sin(wheels.right_m / kRadius_m + 2 * phase);
    }
  return runs;
}

TEST(MaximumLikelihood, TakesWheelsOutOfRoundNeitherForSlipNorForAnotherWheelbase) {
  DriveModel model = astro_drive();
  model.noise.K_m = 5e-7;  // as of a real robot on a clean floor
  constexpr int kTrials = 12;
  double chi_square = 0, K_m = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const MlEstimate found = estimate_ml(
        out_of_round(
            squares(model, 4, 2, simulation::study::derived_seed(kSeed, static_cast<std::uint64_t>(trial))),
            1e-3),
        model.loaded);
    EXPECT_GT(found.spacing_m, 0.03);
    K_m += found.noise.K_m / kTrials;
    for (const double miss : misses(found, model.actual)) chi_square += miss * miss / kTrials;
  }
  std::printf("K %.2e m of %.2e; squares of the errors, in standard errors: %.2f of 3\n", K_m,
              model.noise.K_m, chi_square);
  // Looked at closely, a millimetre per turn of the wheel looks like twenty times that slip.
  EXPECT_LT(K_m, 3 * model.noise.K_m);
  EXPECT_LT(chi_square, 3 + 3 * std::sqrt(6.0 / kTrials));
  EXPECT_GT(chi_square, 3 - 3 * std::sqrt(6.0 / kTrials));
}

/// Squares with a stand after each spin, and a little line after the last one.
std::vector<Trajectory> squares_with_stands(const DriveModel& model, int count, std::uint64_t seed) {
  using simulation::study::Course;
  using simulation::study::Leg;
  std::vector<Trajectory> runs;
  for (int i = 0; i < count; ++i) {
    Course course;
    for (const Leg& leg : simulation::study::square_course(3, i % 2 == 0 ? Sense::cw : Sense::ccw)) {
      course.push_back(leg);
      if (leg.kind == Leg::Kind::turn) course.push_back({Leg::Kind::rest, 0, 0, 1});
    }
    course.back() = {Leg::Kind::straight, 0.3, 0, 0};
    runs.push_back(simulation::study::synthetic_drive(
        course, model, "run " + std::to_string(i + 1),
        simulation::study::derived_seed(seed, static_cast<std::uint64_t>(i))));
  }
  return runs;
}

TEST(MaximumLikelihood, TakesWhatSpinsWindUpNotForSlip) {
  DriveModel model = astro_drive();
  model.noise = {5e-7, 2e-4, 5e-4};
  model.windup_rad = 0.006;
  constexpr int kTrials = 6;
  double bias = 0, K_m = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    const MlEstimate found = estimate_ml(
        squares_with_stands(model, 6, simulation::study::derived_seed(kSeed, trial)), model.loaded);
    K_m += found.noise.K_m / kTrials;
    bias += (found.factors.b_m - model.actual.b_m) / found.se.b_m / kTrials;
  }
  std::printf("K %.2e m of %.2e, b off by %.2f standard errors on average\n", K_m, model.noise.K_m, bias);
  // Of samples in the stands, b would come out smaller by up to 6 mrad in a quarter turn: by twenty standard errors.
  EXPECT_LT(std::abs(bias), 3 / std::sqrt(kTrials));
  EXPECT_LT(K_m, 2 * model.noise.K_m);
  EXPECT_GT(K_m, model.noise.K_m / 2);
}

/// Truth of a tracker whose errors depend on where the body is and which way it looks: about a millimetre and 1.6 mrad, which change within half a metre.
std::vector<Trajectory> tracked_with_returning_errors(std::vector<Trajectory> runs, std::uint64_t seed) {
  constexpr double kWave_radpm = 2 * std::numbers::pi / 1.2;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (int wave = 0; wave < 8; ++wave) {
    const double direction_rad = 9 * normal(random), phase_rad = 9 * normal(random);
    const double x_m = 4e-4 * normal(random), y_m = 4e-4 * normal(random), theta_rad = 8e-4 * normal(random);
    for (Trajectory& run : runs)
      for (BodySample& sample : run.truth) {
        const double along_m = std::cos(direction_rad) * sample.x_m + std::sin(direction_rad) * sample.y_m;
        const double height = std::sin(kWave_radpm * along_m + phase_rad + sample.theta_rad);
        sample.x_m += height * x_m;
        sample.y_m += height * y_m;
        sample.theta_rad += height * theta_rad;
      }
  }
  return runs;
}

TEST(MaximumLikelihood, KnowsThatErrorsWhichReturnInEveryRunDoNotAverageOut) {
  DriveModel model = astro_drive();
  model.noise = {4e-7, 2e-4, 1e-3};
  constexpr int kTrials = 6;
  double claimed = 0, by_runs = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    const std::uint64_t seed = simulation::study::derived_seed(kSeed, trial);
    const MlEstimate found =
        estimate_ml(tracked_with_returning_errors(squares(model, 10, 1.7, seed), seed), model.loaded);
    const Eigen::Vector3d error(found.factors.c_r - model.actual.c_r, found.factors.c_l - model.actual.c_l,
                                found.factors.b_m - model.actual.b_m);
    const Eigen::Matrix3d covariance = found.covariance.topLeftCorner<3, 3>();
    const double chi_square = error.dot(covariance.ldlt().solve(error));
    claimed += chi_square / kTrials;
    by_runs += chi_square * found.widening / found.dispersion / kTrials;
  }
  std::printf("chi-square %.2f of 3; %.2f with Birge's ratio of the runs\n", claimed, by_runs);
  const double far = 3 + 3 * std::sqrt(6.0 / kTrials);  // by chi-square's own scatter
  EXPECT_LT(claimed, far);
  EXPECT_GT(by_runs, far);
}

TEST(MaximumLikelihood, AShortRunAmongThemKeepsNobodyFromSeeingThat) {
  DriveModel model = astro_drive();
  model.noise.K_m = 5e-7;
  std::vector<Trajectory> runs = squares(model, 4, 2);
  runs.push_back(
      simulation::study::synthetic_drive(simulation::study::line_course(0.25, 0.2), model, "short", kSeed));
  const MlEstimate found = estimate_ml(out_of_round(std::move(runs), 1e-3), model.loaded);
  EXPECT_GT(found.spacing_m, 0.03);
  EXPECT_LT(found.noise.K_m, 3 * model.noise.K_m);
}

TEST(MaximumLikelihood, TakesAllTruthOfARobotThatOnlySlips) {
  const DriveModel model = astro_drive();
  EXPECT_EQ(estimate_ml(squares(model, 4, 2), model.loaded).spacing_m, 0);
}

TEST(MaximumLikelihood, EstimatesTheNoiseItself) {
  const DriveModel model = astro_drive();
  const MlEstimate found = estimate_ml(squares(model, 6), model.loaded);
  // 20,000 samples tell the tracker's noise to a percent; the slip hides below it, and K is known to about a
  // fifth.
  EXPECT_NEAR(found.noise.sigma_xy_m, model.noise.sigma_xy_m, 0.03 * model.noise.sigma_xy_m);
  EXPECT_NEAR(found.noise.sigma_theta_rad, model.noise.sigma_theta_rad, 0.03 * model.noise.sigma_theta_rad);
  EXPECT_NEAR(found.noise.K_m, model.noise.K_m, 0.6 * model.noise.K_m);
  EXPECT_NEAR(found.chi_square / found.degrees_of_freedom, 1, 0.03);
}

class Lag : public testing::TestWithParam<double> {};

TEST_P(Lag, OfTheClocksMovesNothing) {
  DriveModel model = astro_drive();
  model.noise.K_m /= 10;  // the sharper the data, the more a lag would hurt
  std::vector<Trajectory> runs = squares(model, 4);
  const MlEstimate without = estimate_ml(runs, model.loaded);
  for (Trajectory& run : runs)
    for (BodySample& sample : run.truth) sample.time_s -= GetParam();
  const MlEstimate with = estimate_ml(runs, model.loaded);
  const double moved[3] = {(with.factors.c_r - without.factors.c_r) / without.se.c_r,
                           (with.factors.c_l - without.factors.c_l) / without.se.c_l,
                           (with.factors.b_m - without.factors.b_m) / without.se.b_m};
  for (const double part : moved) EXPECT_LT(std::abs(part), 0.5);
  for (const RunFit& run : with.runs)
    EXPECT_LT(std::abs(run.clock_offset_s - GetParam()), kFourSigma * run.clock_offset_se_s);
  MlOptions known;
  known.clock_known = true;
  const MlEstimate blind = estimate_ml(runs, model.loaded, known);
  std::printf("%.0f ms: c_R %.3f, c_L %.3f, b %.3f of a standard error (%.1f of b if taken for no lag)\n",
              1000 * GetParam(), moved[0], moved[1], moved[2],
              (blind.factors.b_m - without.factors.b_m) / without.se.b_m);
}

INSTANTIATE_TEST_SUITE_P(Of20And50And100Milliseconds, Lag, testing::Values(0.02, 0.05, 0.1));

TEST(MaximumLikelihood, FindsASlowClock) {
  DriveModel model = astro_drive();
  model.clock_offset_s = 33;
  model.clock_skew = -0.0235;
  const MlEstimate found = estimate_ml(squares(model, 4), model.loaded);
  EXPECT_LT(std::abs(found.sessions[0].clock_skew - model.clock_skew),
            kFourSigma * found.sessions[0].clock_skew_se);
  expect_true(found, model.actual);
}

TEST(MaximumLikelihood, WorksWithPositionsAlone) {
  DriveModel model = astro_drive();
  model.headings = false;
  const MlEstimate found = estimate_ml(squares(model, 4), model.loaded);
  expect_true(found, model.actual);
  EXPECT_TRUE(std::isnan(found.sessions[0].lever.theta_rad));
  EXPECT_LT(std::abs(found.sessions[0].lever.x_m - model.lever.x_m),
            kFourSigma * found.sessions[0].lever_se.x_m);
  EXPECT_LT(std::abs(found.sessions[0].lever.y_m - model.lever.y_m),
            kFourSigma * found.sessions[0].lever_se.y_m);
}

TEST(MaximumLikelihood, TakesABodyMountedAnyWayRound) {
  for (const double yaw : {-3.1, -1.957, 1.5, 3.14}) {
    DriveModel model = astro_drive();
    model.lever = {-0.33, 0.12, yaw};
    expect_true(estimate_ml(squares(model, 2), model.loaded), model.actual);
  }
}

TEST(MaximumLikelihood, IsAbsoluteWhateverTheRobotCarried) {
  // A robot that carries the right factors drives another path; what comes out is the same robot.
  DriveModel model = quiet_drive();
  model.loaded = model.actual;
  const MlEstimate found = estimate_ml(squares(model, 2), model.loaded);
  EXPECT_NEAR(found.factors.c_r, model.actual.c_r, 2e-6);
  EXPECT_NEAR(found.factors.b_m, model.actual.b_m, 2e-6);
}

TEST(MaximumLikelihood, IsNotMovedByASampleInAHundredThatIsWrong) {
  const DriveModel model = astro_drive();
  std::vector<Trajectory> runs = squares(model, 4);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> off(-0.2, 0.2);
  for (Trajectory& run : runs)
    for (std::size_t i = 30; i < run.truth.size(); i += 100) {
      run.truth[i].x_m += off(random);
      run.truth[i].theta_rad += off(random);
    }
  const MlEstimate clean = estimate_ml(squares(model, 4), model.loaded);
  const MlEstimate found = estimate_ml(runs, model.loaded);
  EXPECT_LT(std::abs(found.factors.b_m - clean.factors.b_m), clean.se.b_m);
  EXPECT_LT(std::abs(found.factors.c_r - clean.factors.c_r), clean.se.c_r);
  EXPECT_NEAR(found.noise.sigma_xy_m, model.noise.sigma_xy_m, 0.2 * model.noise.sigma_xy_m);
  MlOptions plain;
  plain.robust = false;
  EXPECT_GT(estimate_ml(runs, model.loaded, plain).noise.sigma_xy_m, 5 * model.noise.sigma_xy_m);
}

/// At `time_s` something turns the robot on the spot, and the wheels do not notice.
void kick(Trajectory& run, double time_s, double angle_rad) {
  const BodySample* pivot = nullptr;
  for (BodySample& sample : run.truth) {
    if (sample.time_s < time_s) {
      pivot = &sample;
      continue;
    }
    const double x = sample.x_m - pivot->x_m, y = sample.y_m - pivot->y_m;
    sample.x_m = pivot->x_m + std::cos(angle_rad) * x - std::sin(angle_rad) * y;
    sample.y_m = pivot->y_m + std::sin(angle_rad) * x + std::cos(angle_rad) * y;
    sample.theta_rad += angle_rad;
  }
}

TEST(MaximumLikelihood, SaysWhenWhichRunWasKicked) {
  DriveModel model = astro_drive();
  std::vector<Trajectory> runs = squares(model, 4);
  const double start_s = runs[2].truth.front().time_s;
  kick(runs[2], start_s + 20, 0.06);
  kick(runs[2], start_s + 31, -0.04);
  runs[1].truth[1000].theta_rad += 1;  // one sample that is wrong is no kick
  const MlEstimate found = estimate_ml(runs, model.loaded);
  for (const RunFit& run : found.runs)
    EXPECT_THAT(run.slip_events, testing::SizeIs(run.name == "run 3" ? 2 : 0)) << run.name;
  const std::vector<SlipEvent>& slip_events = found.runs[2].slip_events;
  // Half a second of truth tells a heading to 0.6 mrad, and slip adds as much; moments are a tenth of it
  // apart.
  EXPECT_NEAR(slip_events[0].since_start_s, 20, 0.1);
  EXPECT_NEAR(slip_events[0].turned_rad, 0.06, 5e-3);
  EXPECT_NEAR(slip_events[1].since_start_s, 31, 0.1);
  EXPECT_NEAR(slip_events[1].turned_rad, -0.04, 5e-3);
  EXPECT_THAT(remarks(found), testing::Contains(support::Tells(JudgementProblem::run_slipped, "run 3",
                                                               testing::_, testing::StartsWith("3."),
                                                               testing::_, testing::StartsWith("-2."))));
}

TEST(MaximumLikelihood, ComesToAnEndForManyRunsOfWhichEachHasOtherWheels) {
  simulation::study::DriveModel model = astro_drive();
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  std::vector<Trajectory> runs;
  for (std::uint64_t i = 0; i < 16; ++i) {
    model.actual.c_r = astro_drive().actual.c_r * (1 + 0.02 * normal(random));
    model.actual.b_m = astro_drive().actual.b_m * (1 + 0.03 * normal(random));
    runs.push_back(simulation::study::synthetic_drive(
        simulation::study::square_course(1, i % 2 == 0 ? Sense::cw : Sense::ccw), model,
        "run " + std::to_string(i + 1), simulation::study::derived_seed(kSeed, i)));
  }
  const MlEstimate found = estimate_ml(runs, model.loaded);
  // Known as the mean of runs is that scatter by 2 % and 3 %, not as squares without such a scatter are, to 0.1 %.
  EXPECT_GT(found.se.E_d, 0.02 / 4 / 2);
  EXPECT_NEAR(found.factors.b_m, astro_drive().actual.b_m, 5 * 0.03 / 4 * model.actual.b_m);
}

TEST(MaximumLikelihood, IsMovedLessByAKickOfTheCastor) {
  DriveModel model = astro_drive();
  model.lever = {};
  const std::vector<Trajectory> clean = squares(model, 4, 2);
  std::vector<Trajectory> kicked = clean;
  for (Trajectory& run : kicked) kick(run, run.truth.front().time_s + 3, 0.06);  // always to the left
  MlOptions plain;
  plain.robust = false;
  const MlEstimate reference = estimate_ml(clean, model.loaded), robust = estimate_ml(kicked, model.loaded);
  const MlEstimate moved = estimate_ml(kicked, model.loaded, plain);
  const auto shift = [&](const MlEstimate& found) {
    return std::abs(found.E_d() - reference.E_d()) / reference.se.E_d;
  };
  std::printf("E_d moves by %.2f standard errors, by least squares %.2f\n", shift(robust), shift(moved));
  // At 60 Hz a kick is first taken for a bad sample, for as long as it outweighs the tracker's noise: that
  // much of it stays.
  EXPECT_LT(shift(robust), shift(moved) / 2);
  expect_true(robust, model.actual);
}

TEST(MaximumLikelihood, GetsAlongWithGapsInTheTruth) {
  const DriveModel model = astro_drive();
  std::vector<Trajectory> runs = squares(model, 4);
  for (Trajectory& run : runs)
    std::erase_if(run.truth, [](const BodySample& s) { return std::fmod(s.time_s, 7) > 5.5; });
  expect_true(estimate_ml(runs, model.loaded), model.actual);
}

TEST(MaximumLikelihood, NamesTheRunThatSlipped) {
  const DriveModel model = astro_drive();
  std::vector<Trajectory> runs = squares(model, 8);
  EXPECT_THAT(remarks(estimate_ml(runs, model.loaded)), IsEmpty());
  const MlEstimate clean = estimate_ml(runs, model.loaded);
  // The third run ends somewhere else than its wheels went: 5 degrees about the tracker's origin.
  for (BodySample& sample : runs[2].truth) {
    if (sample.time_s < 20) continue;
    constexpr double kKick_rad = 0.087;
    const double x = sample.x_m, y = sample.y_m;
    sample.x_m = std::cos(kKick_rad) * x - std::sin(kKick_rad) * y;
    sample.y_m = std::sin(kKick_rad) * x + std::cos(kKick_rad) * y;
    sample.theta_rad += kKick_rad;
  }
  const MlEstimate found = estimate_ml(runs, model.loaded);
  for (const RunFit& run : found.runs)
    EXPECT_EQ(run.outlier, run.name == "run 3") << run.name << ' ' << run.disagreement;
  // The others say what they said before.
  EXPECT_LT(std::abs(found.E_d() - clean.E_d()), clean.se.E_d);
  EXPECT_LT(found.se.E_d, 1.3 * clean.se.E_d);
  EXPECT_THAT(remarks(found).front(), support::Tells(JudgementProblem::run_stands_out, "run 3"));
}

/// Squares, and circles about 1.5 m wide.
std::vector<Trajectory> squares_and_circles(const DriveModel& model, int of_each,
                                            std::uint64_t seed = kSeed) {
  std::vector<Trajectory> runs = squares(model, of_each, 3, seed);
  for (int i = 0; i < of_each; ++i)
    runs.push_back(simulation::study::synthetic_drive(
        simulation::study::circle_course(0.75, (i % 2 == 0 ? 4 : -4) * std::numbers::pi), model,
        "circle " + std::to_string(i + 1),
        simulation::study::derived_seed(seed, 90 + static_cast<std::uint64_t>(i))));
  return runs;
}

TEST(MaximumLikelihood, FindsHowMuchWiderTheWheelbaseIsInArcs) {
  DriveModel model = astro_drive();
  model.noise.K_m = 1e-6;
  model.actual.e = 0.02;
  const MlEstimate found = estimate_ml(squares_and_circles(model, 4), model.loaded);
  expect_true(found, model.actual);
  EXPECT_LT(std::abs(found.factors.e - 0.02), kFourSigma * found.se.e);
  EXPECT_GT(found.factors.e, kFourSigma * found.se.e);
  EXPECT_EQ(found.dispersion, 1);
}

TEST(MaximumLikelihood, ClaimsNoEOfARobotThatHasNone) {
  const DriveModel model = astro_drive();
  int claimed = 0;
  double chi_square = 0;
  constexpr int kTrials = 10;
  for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
    const MlEstimate found = estimate_ml(squares_and_circles(model, 2, seed), model.loaded);
    expect_true(found, model.actual);
    chi_square += std::pow(found.factors.e / found.se.e, 2) / kTrials;
    if (two_wheelbases(found.factors.e, found.se.e) != Shown::no) ++claimed;
  }
  EXPECT_LT(chi_square, 1 + 3 * std::sqrt(2.0 / kTrials));
  EXPECT_LT(claimed, 4) << "one in twenty by chance, so four of ten once in a thousand times";
}

TEST(MaximumLikelihood, LeavesEAtItsPriorWhereCirclesAloneCannotTellItFromTheWheelbase) {
  DriveModel model = astro_drive();
  model.noise.K_m = 1e-6;
  model.actual.e = 0.02;
  std::vector<Trajectory> circles = squares_and_circles(model, 4);
  circles.erase(circles.begin(), circles.begin() + 4);
  const MlEstimate found = estimate_ml(circles, model.loaded);
  EXPECT_GT(found.se.e, 0.9 * PriorOfE::kStandardDeviation);
  EXPECT_LT(std::abs(found.factors.e), 0.1 * PriorOfE::kStandardDeviation);
  expect_true(found, model.actual);
  // The wheelbase of these arcs is known well all the same: b and e are uncertain together.
  const double g = kUsualKappa0 / (kUsualKappa0 + model.actual.b_m / 0.75);
  const Eigen::Vector4d by(0, 0, 1 + found.factors.e * g, found.factors.b_m * g);
  EXPECT_LT(std::sqrt(by.dot(found.covariance * by)), 0.2 * found.se.b_m);
}

TEST(MaximumLikelihood, DoesNotTakeTheRoundingOfCountsForAnE) {
  DriveModel model = astro_drive();
  model.metres_per_count = 8.07e-5;
  const MlEstimate found = estimate_ml(squares(model, 40), model.loaded);
  // With the rounding in the derivative by e it is 0.046, more than two standard errors.
  EXPECT_LT(std::abs(found.factors.e), PriorOfE::kStandardDeviation / 2);
  expect_true(found, model.actual);
}

TEST(MaximumLikelihood, TakesRunsWithAndWithoutHeadingsTogether) {
  DriveModel model = astro_drive();
  std::vector<Trajectory> runs = squares(model, 2);
  model.headings = false;
  for (Trajectory& run : squares(model, 2, 3, kSeed + 1)) runs.push_back(std::move(run));
  expect_true(estimate_ml(runs, model.loaded), model.actual);
}

TEST(MaximumLikelihood, TakesRunsWithOtherClocksEach) {
  DriveModel model = astro_drive();
  std::vector<Trajectory> runs;
  // A line first: it tells an offset and next to nothing of the skew.
  model.clock_skew = 0.01;
  runs.push_back(simulation::study::synthetic_drive(simulation::study::line_course(1), model, "line", kSeed));
  for (const double offset_s : {0.3, -500.0, 77.7}) {
    model.clock_offset_s = offset_s;
    runs.push_back(squares(model, 1, 3, kSeed + runs.size()).front());
  }
  const MlEstimate found = estimate_ml(runs, model.loaded);
  expect_true(found, model.actual);
  EXPECT_LT(std::abs(found.sessions[0].clock_skew - 0.01), kFourSigma * found.sessions[0].clock_skew_se);
}

TEST(MaximumLikelihood, FindsTheClockOfATrackerThatIsOffByCentimetres) {
  DriveModel model = astro_drive();
  model.noise.sigma_xy_m = 0.05;
  model.noise.sigma_theta_rad = 3 * std::numbers::pi / 180;
  for (const auto& [offset_s, skew] : {std::pair{0.5, 0.0}, {482.3, -0.0235}}) {
    model.clock_offset_s = offset_s;
    model.clock_skew = skew;
    const MlEstimate found = estimate_ml(squares(model, 4), model.loaded);
    expect_true(found, model.actual);
    EXPECT_LT(std::abs(found.sessions[0].clock_skew - skew), kFourSigma * found.sessions[0].clock_skew_se);
    for (const RunFit& run : found.runs)
      EXPECT_LT(std::abs(run.clock_offset_s - offset_s), kFourSigma * run.clock_offset_se_s);
  }
}

TEST(MaximumLikelihood, UsesSpinsOfPositionsAloneWithABodyOffTheAxis) {
  DriveModel model = astro_drive();
  model.headings = false;
  model.clock_offset_s = 482.3;
  // Ahead, behind, and beside: a body that trails lets a search from no lever at all go astray.
  for (const LeverArm& lever : {LeverArm{0.3, 0, 0}, {-0.3, 0, 0}, {-0.2, -0.2, 0}}) {
    model.lever = lever;
    std::vector<Trajectory> runs = squares(model, 2, 1.7);
    runs.push_back(
        simulation::study::synthetic_drive(simulation::study::spin_course(19), model, "spin", kSeed));
    const MlEstimate found = estimate_ml(runs, model.loaded);
    expect_true(found, model.actual);
    EXPECT_EQ(found.runs.size(), 3u);
    EXPECT_LT(std::abs(found.sessions[0].lever.x_m - lever.x_m), kFourSigma * found.sessions[0].lever_se.x_m);
  }
}

TEST(MaximumLikelihood, DoesWithoutASpinThatPositionsCannotSee) {
  DriveModel model = astro_drive();
  model.headings = false;
  model.lever = {};
  model.clock_offset_s = 7;
  std::vector<Trajectory> runs = squares(model, 4);
  runs.insert(runs.begin() + 1,
              simulation::study::synthetic_drive(simulation::study::spin_course(19), model, "spin", kSeed));
  const MlEstimate found = estimate_ml(runs, model.loaded);
  expect_true(found, model.actual);
  EXPECT_EQ(found.runs.size(), 4u);
  EXPECT_THAT(remarks(found), testing::Contains(support::Tells(PreparationProblem::positions_stay, "spin")));
}

TEST(MaximumLikelihood, CallsAWideCircleATurn) {
  DriveModel model = astro_drive();
  std::vector<Trajectory> runs;
  for (const double turn : {1.0, -1.0})
    runs.push_back(simulation::study::synthetic_drive(
        simulation::study::circle_course(4, turn * 2 * std::numbers::pi), model, "circle", kSeed));
  runs.push_back(simulation::study::synthetic_drive(simulation::study::line_course(3), model, "line", kSeed));
  expect_true(estimate_ml(runs, model.loaded), model.actual);
}

TEST(MaximumLikelihood, SaysSoWhenTheGivenNoiseIsTooSmall) {
  const DriveModel model = astro_drive();
  MlOptions options;
  options.noise = NoiseModel{model.noise.K_m, model.noise.sigma_xy_m / 5, model.noise.sigma_theta_rad / 5};
  MlEstimate found = estimate_ml(squares(model, 2), model.loaded, options);
  EXPECT_THAT(remarks(found, true),
              testing::Contains(support::Tells(JudgementProblem::given_noise_is_wrong)));
  EXPECT_THAT(remarks(found, false),
              testing::Contains(support::Tells(JudgementProblem::estimated_noise_is_wrong)))
      << "noise that nobody gave cannot be left out";
}

TEST(MaximumLikelihood, TellsTheMotionsApart) {
  const DriveModel model = astro_drive();
  std::vector<Trajectory> runs = squares(model, 2);
  runs.push_back(simulation::study::synthetic_drive(
      simulation::study::circle_course(0.75, 2 * std::numbers::pi), model, "circle", kSeed));
  const MlEstimate found = estimate_ml(runs, model.loaded);
  ASSERT_EQ(found.kinds.size(), 4u);
  EXPECT_EQ(found.kinds[0].motion, Motion::rest);
  EXPECT_NEAR(found.kinds[1].distance_m, 24, 0.5);                      // lines of two squares
  EXPECT_NEAR(found.kinds[2].rotation_rad, 2 * std::numbers::pi, 0.4);  // the circle
  EXPECT_NEAR(found.kinds[3].rotation_rad, 4 * std::numbers::pi, 0.5);  // their corners
}

TEST(CramerRaoBound, CountsNoTruthThatTheEstimateLeavesUnused) {
  DriveModel model = astro_drive();
  model.count_rate_hz = 20;
  model.noise.sigma_xy_m = 0.03;
  model.noise.sigma_theta_rad = 0.05;
  MlOptions options;
  options.noise = model.noise;
  const auto bound = [&](double truth_rate_hz) {
    model.truth_rate_hz = truth_rate_hz;
    return errors_of(cramer_rao_bound(squares(model, 2), model.actual, model.lever, options), model.actual);
  };
  // 60 and 100 Hz leave one sample for each of the wheels, as 20 Hz do; 1 % for which of them that is.
  const MlErrors one = bound(20);
  for (const double rate_hz : {60.0, 100.0}) {
    EXPECT_NEAR(bound(rate_hz).scale, one.scale, 0.01 * one.scale) << rate_hz;
    EXPECT_NEAR(bound(rate_hz).b_over_scale_m, one.b_over_scale_m, 0.01 * one.b_over_scale_m) << rate_hz;
  }
}

TEST(CramerRaoBound, KeepsTheDesignRulesForTenSquares) {
  // precision.hpp: within 4 % for a tracker that follows the whole drive.
  const DriveModel model = astro_drive();
  MlOptions options;
  options.noise = model.noise;
  const MlErrors bound =
      errors_of(cramer_rao_bound(squares(model, 10), model.actual, model.lever, options), model.actual);
  EXPECT_NEAR(bound.E_d, std::sqrt(2 * model.noise.K_m / 120), 0.05 * bound.E_d);
  EXPECT_NEAR(bound.scale, std::sqrt(model.noise.K_m / 240), 0.05 * bound.scale);
  EXPECT_NEAR(bound.b_m / 0.29, std::sqrt(model.noise.K_m / (0.29 * 20 * std::numbers::pi)),
              0.08 * bound.b_m / 0.29);
}

}  // namespace
}  // namespace astro::calibration
