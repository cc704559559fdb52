#include "host/simulation/study/simulated_source.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/experiment/files/plan_problem.hpp"
#include "host/robot/parameters/parameter_problem.hpp"
#include "host/simulation/study/limits.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::simulation {
namespace {

using calibration::MlEstimate;
using calibration::Trajectory;
using simulation::study::Drives;
using simulation::study::SetupProblem;
using simulation::study::TrialSetup;
using support::Tells;

TrialSetup small_setup() {
  TrialSetup setup;
  setup.model = simulation::study::Model::simulator;
  setup.runs = 1;
  setup.side_m = 1;
  return setup;
}

Remark refusal(const TrialSetup& setup) {
  return support::told_by([&] { SimulatedSource().check(setup); });
}

bool same(const Trajectory& a, const Trajectory& b) {
  const auto wheels = [](const auto& x, const auto& y) {
    return x.time_s == y.time_s && x.left_m == y.left_m && x.right_m == y.right_m;
  };
  const auto truth = [](const auto& x, const auto& y) {
    return x.time_s == y.time_s && x.x_m == y.x_m && x.y_m == y.y_m && x.theta_rad == y.theta_rad;
  };
  return std::ranges::equal(a.wheels, b.wheels, wheels) && std::ranges::equal(a.truth, b.truth, truth);
}

// 72 mm wheels, 64 x 43.8 counts a turn.
constexpr double kCount_m = std::numbers::pi * 0.072 / (64 * 43.8);

MlEstimate estimate_of(const TrialSetup& setup) {
  calibration::MlOptions options = setup.ml_options();
  options.noise = setup.noise;  // there is none to estimate
  return estimate_ml(SimulatedSource().without_noise(setup), setup.loaded(), options);
}

void expect_true_factors(const TrialSetup& setup) {
  const MlEstimate found = estimate_of(setup);
  const double E_d = found.E_d() - setup.E_d, scale = found.scale() - setup.scale,
               b = found.factors.b_m / setup.actual().b_m - 1;
  fmt::print("errors of E_d {:.1e}, S {:.1e}, b {:.1e}\n", E_d, scale, b);
  // One count in a round: four sides, and four quarter turns of both wheels' difference.
  const double along = kCount_m / (4 * setup.side_m),
               round = kCount_m / (2 * std::numbers::pi * setup.wheelbase_m);
  EXPECT_NEAR(E_d, 0, along);
  EXPECT_NEAR(scale, 0, along);
  EXPECT_NEAR(b, 0, round);
}

TEST(SimulatedSource, WithoutSlipAndTrackerNoiseTheTrueFactorsAreFoundToACount) {
  expect_true_factors(small_setup());
}

TEST(SimulatedSource, DrivesARobotThatIsOffInEveryWayAndBelievesInAnotherWheelbase) {
  TrialSetup setup = small_setup();
  setup.wheelbase_m = 0.4;
  setup.E_d = 0.97;
  setup.E_b = 1.05;
  setup.scale = 0.96;
  expect_true_factors(setup);
}

TEST(SimulatedSource, DrivesARobotOnWideTyresInSquaresAndCircles) {
  TrialSetup setup = small_setup();
  setup.circles = 1;
  setup.e = 0.02;
  setup.noise.K_m = 1e-7;  // with more, one circle each way would not show e
  const Drives drives = SimulatedSource().of_trial(setup, 0);
  ASSERT_EQ(drives.runs.size(), 4U);
  EXPECT_EQ(drives.runs[3].name, "circle ccw 1");
  EXPECT_EQ(drives.end_errors.size(), 2U);
  expect_true_factors(setup);
  const double e = estimate_of(setup).factors.e;
  fmt::print("e {:.5f}\n", e);
  // A fifth of e acts in the circle, of two turns of which one count in a wheel is so much.
  EXPECT_NEAR(e, setup.e, 5 * kCount_m / (4 * std::numbers::pi * setup.wheelbase_m) + 0.02 * setup.e);
}

TEST(SimulatedSource, GivesTheSameDrivesForTheSameTrialToTheLastBitAndOthersForAnother) {
  const TrialSetup setup = small_setup();
  const SimulatedSource source;
  const Drives first = source.of_trial(setup, 3), again = source.of_trial(setup, 3),
               other = source.of_trial(setup, 4);
  ASSERT_EQ(first.runs.size(), 2U);
  EXPECT_EQ(first.runs[0].name, "square cw 1");
  EXPECT_EQ(first.runs[1].name, "square ccw 1");
  for (std::size_t run = 0; run < 2; ++run) {
    EXPECT_TRUE(same(first.runs[run], again.runs[run]));
    EXPECT_EQ(first.end_errors[run].x_m, again.end_errors[run].x_m);
    EXPECT_FALSE(same(first.runs[run], other.runs[run]));
    EXPECT_NE(first.end_errors[run].x_m, other.end_errors[run].x_m);
  }
}

TEST(SimulatedSource, MovesTheCamerasTimesAndNothingElseWhereTheClockIsToBeEstimated) {
  TrialSetup setup = small_setup();
  const Drives known = SimulatedSource().of_trial(setup, 0);
  setup.clock_known = false;
  Drives estimated = SimulatedSource().of_trial(setup, 0);
  const std::vector<double> offsets_s = clock_offsets_s(setup, 0);
  for (std::size_t run = 0; run < 2; ++run) {
    EXPECT_NE(offsets_s[run], 0);
    EXPECT_EQ(estimated.end_errors[run].x_m, known.end_errors[run].x_m) << "which no clock changes";
    for (std::size_t i = 0; i < estimated.runs[run].truth.size(); ++i) {
      EXPECT_EQ(estimated.runs[run].truth[i].time_s, known.runs[run].truth[i].time_s - offsets_s[run]);
      estimated.runs[run].truth[i].time_s = known.runs[run].truth[i].time_s;
    }
    EXPECT_TRUE(same(estimated.runs[run], known.runs[run]));
  }
}

TEST(SimulatedSource, RefusesWhatTheRobotCannotDriveOrRecord) {
  TrialSetup setup = small_setup();
  EXPECT_NO_THROW(SimulatedSource().check(setup));
  setup.count_rate_hz = 50;
  EXPECT_THAT(refusal(setup), Tells(SetupProblem::count_rate_not_recorded));
  setup = small_setup();
  setup.side_m = 0.05;
  EXPECT_THAT(refusal(setup), Tells(experiment::PlanProblem::out_of_range, "side_m", "0.05"));
  setup = small_setup();
  setup.windup_rad = 0.006;
  EXPECT_THAT(refusal(setup), Tells(SetupProblem::windup_not_simulated));
  setup = small_setup();
  setup.trials = 0;
  EXPECT_THAT(refusal(setup),
              Tells(simulation::study::LimitProblem::out_of_range, "the number of trials", "0"));
  setup = small_setup();
  setup.model = simulation::study::Model::kinematic;
  EXPECT_THAT(refusal(setup), Tells(SetupProblem::of_other_model, "kinematic", "simulator"));
  setup = small_setup();
  setup.wheelbase_m = 3;
  EXPECT_THAT([&] { SimulatedSource().of_trial(setup, 0); },
              support::ThrowsTelling(robot::ParameterProblem::out_of_range, "b", "3 m", "0.05 m to 2 m"));
}

}  // namespace
}  // namespace astro::simulation
