#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "host/calibration/likelihood/likelihood_problem.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/preparation/preparation_problem.hpp"
#include "tests/host/calibration/ml_drives.hpp"
#include "tests/support/base/remarks.hpp"

// What cannot be calibrated is refused with what is wrong and with the run that is.
namespace astro::calibration {
namespace {

using simulation::study::DriveModel;
using support::Tells;
using Likelihood = LikelihoodProblem;
using Preparation = PreparationProblem;

constexpr double kPi = std::numbers::pi;

Remark told(const std::vector<Trajectory>& runs) {
  return support::told_by([&] { estimate_ml(runs, astro_drive().loaded); });
}

std::vector<Trajectory> one(const simulation::study::Course& course,
                            const DriveModel& model = astro_drive()) {
  return {simulation::study::synthetic_drive(course, model, "run 7", kSeed)};
}

TEST(MlRefuses, NoRuns) { EXPECT_THAT(told({}), Tells(Preparation::no_runs)); }

TEST(MlRefuses, ARunWithoutGroundTruth) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  runs[0].truth.resize(2);
  EXPECT_THAT(told(runs), Tells(Preparation::too_little_truth, "run 1", "2"));
}

TEST(MlRefuses, ARunWithoutOdometry) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  runs[0].wheels.clear();
  EXPECT_THAT(told(runs), Tells(Preparation::no_odometry, "run 1"));
}

TEST(MlRefuses, ARunTooShort) {
  EXPECT_THAT(told(one(simulation::study::line_course(0.1))), Tells(Preparation::too_short, "run 7"));
}

TEST(MlRefuses, TimesThatRunBackwards) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  std::swap(runs[0].truth[50].time_s, runs[0].truth[70].time_s);
  EXPECT_THAT(told(runs), Tells(Preparation::times_run_backwards, "run 1", "ground truth"));
}

TEST(MlRefuses, AClockThatWasSet) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  for (std::size_t i = 1; i < runs[0].truth.size(); ++i) runs[0].truth[i].time_s += 1.7e9;
  EXPECT_THAT(told(runs), Tells(Preparation::times_jump, "run 1", "ground truth"));
}

TEST(MlRefuses, NumbersThatAreNone) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  runs[0].wheels[100].left_m = std::nan("");
  EXPECT_THAT(told(runs), Tells(Preparation::odometry_not_finite, "run 1"));
  runs = squares(astro_drive(), 1);
  runs[0].truth[100].time_s = std::nan("");
  EXPECT_THAT(told(runs), Tells(Preparation::times_missing, "run 1", "ground truth"));
}

TEST(MlRefuses, OdometryThatWasLostOnMostOfTheWay) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  const double end_s = runs[0].wheels.back().time_s;
  std::erase_if(runs[0].wheels, [&](const WheelSample& s) { return s.time_s > 5 && s.time_s < 0.8 * end_s; });
  EXPECT_THAT(told(runs), Tells(Preparation::odometry_lost, "run 1"));
}

TEST(MlRefuses, AReversedEncoder) {
  std::vector<Trajectory> runs = squares(astro_drive(), 2);
  for (Trajectory& run : runs)
    for (WheelSample& sample : run.wheels) sample.left_m = -sample.left_m;
  EXPECT_THAT(told(runs), Tells(Preparation::nothing_in_common, "run 1"));
}

TEST(MlRefuses, ASpinOfExchangedWheelsWithAllItsCauses) {
  std::vector<Trajectory> runs = one(simulation::study::spin_course(4 * kPi));
  for (WheelSample& sample : runs[0].wheels) std::swap(sample.left_m, sample.right_m);
  EXPECT_THAT(told(runs), Tells(Preparation::mirrored_or_clockwise, "run 7"));
}

TEST(MlRefuses, TruthOfAnotherDrive) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  runs[0].truth = one({{simulation::study::Leg::Kind::rest, 0, 0, 11},
                       {simulation::study::Leg::Kind::straight, 0.7, 0, 0},
                       {simulation::study::Leg::Kind::rest, 0, 0, 40}})[0]
                      .truth;
  EXPECT_THAT(told(runs), Tells(Preparation::nothing_in_common, "run 1"));
}

/// Laps of which the wheels recorded a part, and that part fits each of them.
std::vector<Trajectory> laps_recorded_in_part() {
  simulation::study::Course course{{simulation::study::Leg::Kind::rest, 0, 0, 1}};
  for (int side = 0; side < 32; ++side) {
    course.push_back({simulation::study::Leg::Kind::straight, 0.5, 0, 0});
    course.push_back({simulation::study::Leg::Kind::turn, 0, kPi / 2, 0});
  }
  DriveModel model = astro_drive();
  model.clock_offset_s = 300;
  std::vector<Trajectory> runs = one(course, model);
  std::erase_if(runs[0].wheels, [](const WheelSample& s) { return s.time_s < 40 || s.time_s > 80; });
  return runs;
}

TEST(MlRefuses, ADriveWhoseLapsCannotBeTold) {
  EXPECT_THAT(told(laps_recorded_in_part()), Tells(Preparation::clock_unsettled, "run 7"));
}

TEST(MlRefuses, NoOtherDriveForOneWhoseLapsCannotBeTold) {
  std::vector<Trajectory> runs = laps_recorded_in_part();
  const std::vector<Trajectory> good = squares(astro_drive(), 2);
  runs.insert(runs.end(), good.begin(), good.end());
  const MlEstimate all = estimate_ml(runs, astro_drive().loaded);
  ASSERT_THAT(all.left_out, testing::SizeIs(1));
  EXPECT_THAT(all.left_out[0], Tells(Preparation::clock_unsettled, "run 7"));
  EXPECT_EQ(all.factors.b_m, estimate_ml(good, astro_drive().loaded).factors.b_m);
}

TEST(MlRefuses, SpinsUnderPositionsThatStandStill) {
  DriveModel model = astro_drive();
  model.headings = false;
  model.lever = {};
  model.clock_offset_s = 7;
  EXPECT_THAT(told(one(simulation::study::spin_course(6 * kPi), model)),
              Tells(Preparation::positions_stay, "run 7"));
}

TEST(MlRefuses, HeadingsThatNeverChange) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  for (BodySample& sample : runs[0].truth) sample.theta_rad = 0.3;
  EXPECT_THAT(told(runs), Tells(Preparation::heading_stays, "run 1"));
}

TEST(MlRefuses, MirroredAxes) {
  std::vector<Trajectory> runs = squares(astro_drive(), 2);
  for (Trajectory& run : runs)
    for (BodySample& sample : run.truth) {
      sample.y_m = -sample.y_m;
      sample.theta_rad = -sample.theta_rad;
    }
  EXPECT_THAT(told(runs), Tells(Preparation::mirrored, "run 1"));
}

TEST(MlRefuses, MirroredAxesWithoutHeadings) {
  DriveModel model = astro_drive();
  model.headings = false;
  std::vector<Trajectory> runs = squares(model, 2);
  for (Trajectory& run : runs)
    for (BodySample& sample : run.truth) sample.y_m = -sample.y_m;
  EXPECT_THAT(told(runs), Tells(Preparation::mirrored, "run 1"));
}

TEST(MlRefuses, ExchangedWheels) {
  std::vector<Trajectory> runs = squares(astro_drive(), 2);
  for (Trajectory& run : runs)
    for (WheelSample& sample : run.wheels) std::swap(sample.left_m, sample.right_m);
  EXPECT_THAT(told(runs), Tells(Preparation::mirrored, "run 1"));
}

TEST(MlRefuses, HeadingsCountedClockwise) {
  std::vector<Trajectory> runs = squares(astro_drive(), 2);
  for (Trajectory& run : runs)
    for (BodySample& sample : run.truth) sample.theta_rad = -sample.theta_rad;
  EXPECT_THAT(told(runs), Tells(Preparation::headings_clockwise, "run 1"));
}

TEST(MlRefuses, ARobotThatNeverTurned) {
  EXPECT_THAT(told(one(simulation::study::line_course(4))), Tells(Likelihood::never_turned));
}

TEST(MlRefuses, ARobotThatOnlySpun) {
  EXPECT_THAT(told(one(simulation::study::spin_course(6 * kPi))), Tells(Likelihood::only_spun));
}

TEST(MlRefuses, OneCircleAlone) {
  // Two observables, three unknowns.
  DriveModel model = quiet_drive();
  model.acceleration_mps2 = 100;
  for (const double radius_m : {0.5, 1.0, 1.7})
    for (const double turn_rad : {4 * kPi, -4 * kPi})
      EXPECT_THAT(told(one(simulation::study::circle_course(radius_m, turn_rad, 0.3), model)),
                  Tells(Likelihood::all_move_alike));
}

TEST(MlRefuses, TruthInMillimetres) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  for (BodySample& sample : runs[0].truth) {
    sample.x_m *= 1000;
    sample.y_m *= 1000;
  }
  EXPECT_THAT(told(runs), Tells(Likelihood::implausible_factors));
}

TEST(MlRefuses, StampsThatAreTimesOfArrivalOfBursts) {
  std::vector<Trajectory> runs = squares(astro_drive(), 4, 2);
  for (Trajectory& run : runs) {
    // All that was sent within 0.4 s has one stamp, of which the first sample stays.
    std::vector<WheelSample> first;
    for (WheelSample sample : run.wheels) {
      sample.time_s = 0.4 * std::ceil(sample.time_s / 0.4 + (first.size() % 3 == 0 ? 0.8 : 0.0));
      if (first.empty() || sample.time_s > first.back().time_s) first.push_back(sample);
    }
    run.wheels = first;
  }
  // The wheels go as far as the truth, so nothing is said of units.
  try {
    const MlEstimate found = estimate_ml(runs, {1, 1, 0.29});
    EXPECT_NEAR(found.factors.c_r, astro_drive().actual.c_r, 3 * found.se.c_r);
  } catch (const Error& error) {
    EXPECT_NE(error.kind(), Kind(Likelihood::implausible_factors)) << error.what();
  }
}

TEST(MlRefuses, AWheelbaseOfHalfOrTwiceTheLoadedOne) {
  const std::vector<Trajectory> runs = squares(astro_drive(), 2);
  for (const double loaded_m : {0.145, 0.58})
    EXPECT_EQ(support::told_by([&] {
                estimate_ml(runs, {1, 1, loaded_m});
              }).kind,
              Kind(Likelihood::wheelbase_unlike));
}

}  // namespace
}  // namespace astro::calibration
