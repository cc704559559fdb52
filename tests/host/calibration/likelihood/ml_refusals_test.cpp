#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "tests/host/calibration/ml_drives.hpp"
#include "tests/support/base/remarks.hpp"

// What cannot be calibrated is said in one sentence that names it and the remedy.
namespace astro::calibration {
namespace {

using simulation::study::DriveModel;
using support::Tells;
using testing::AllOf;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

Remark told(const std::vector<Trajectory>& runs) {
  return support::told_by([&] { estimate_ml(runs, astro_drive().loaded); });
}

std::string refusal(const std::vector<Trajectory>& runs) { return told(runs).sentence; }

std::vector<Trajectory> one(const simulation::study::Course& course,
                            const DriveModel& model = astro_drive()) {
  return {simulation::study::synthetic_drive(course, model, "run 7", kSeed)};
}

TEST(MlRefuses, NoRuns) { EXPECT_THAT(refusal({}), HasSubstr("no runs")); }

TEST(MlRefuses, ARunWithoutGroundTruth) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  runs[0].truth.resize(2);
  EXPECT_THAT(told(runs), Tells(AllOf(HasSubstr("run 1"), HasSubstr("2 samples")), Help::use_end_poses));
}

TEST(MlRefuses, ARunWithoutOdometry) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  runs[0].wheels.clear();
  EXPECT_THAT(refusal(runs), AllOf(HasSubstr("run 1"), HasSubstr("no odometry")));
}

TEST(MlRefuses, ARunTooShort) {
  EXPECT_THAT(refusal(one(simulation::study::line_course(0.1))),
              AllOf(HasSubstr("run 7"), HasSubstr("too short")));
}

TEST(MlRefuses, TimesThatRunBackwards) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  std::swap(runs[0].truth[50].time_s, runs[0].truth[70].time_s);
  EXPECT_THAT(refusal(runs), AllOf(HasSubstr("run 1"), HasSubstr("backwards")));
}

TEST(MlRefuses, AClockThatWasSet) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  for (std::size_t i = 1; i < runs[0].truth.size(); ++i) runs[0].truth[i].time_s += 1.7e9;
  EXPECT_THAT(refusal(runs), AllOf(HasSubstr("run 1"), HasSubstr("jumps")));
}

TEST(MlRefuses, NumbersThatAreNone) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  runs[0].wheels[100].left_m = std::nan("");
  EXPECT_THAT(refusal(runs), AllOf(HasSubstr("run 1"), HasSubstr("no number")));
  runs = squares(astro_drive(), 1);
  runs[0].truth[100].time_s = std::nan("");
  EXPECT_THAT(refusal(runs), AllOf(HasSubstr("run 1"), HasSubstr("without a time")));
}

TEST(MlRefuses, OdometryThatWasLostOnTheWay) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  std::erase_if(runs[0].wheels, [](const WheelSample& s) { return s.time_s > 10 && s.time_s < 13; });
  EXPECT_THAT(told(runs), Tells(AllOf(HasSubstr("run 1"), HasSubstr("lost its odometry")),
                                Help::leave_out_or_record_again));
}

TEST(MlRefuses, AReversedEncoder) {
  std::vector<Trajectory> runs = squares(astro_drive(), 2);
  for (Trajectory& run : runs)
    for (WheelSample& sample : run.wheels) sample.left_m = -sample.left_m;
  EXPECT_EQ(told(runs).remedy.help, Help::check_run_and_wiring);
}

TEST(MlRefuses, ASpinOfExchangedWheelsWithAllItsCauses) {
  std::vector<Trajectory> runs = one(simulation::study::spin_course(4 * kPi));
  for (WheelSample& sample : runs[0].wheels) std::swap(sample.left_m, sample.right_m);
  EXPECT_THAT(refusal(runs), AllOf(HasSubstr("mirrored"), HasSubstr("clockwise"), HasSubstr("exchanged")));
}

TEST(MlRefuses, TruthOfAnotherDrive) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  runs[0].truth = one({{simulation::study::Leg::Kind::rest, 0, 0, 11},
                       {simulation::study::Leg::Kind::straight, 0.7, 0, 0},
                       {simulation::study::Leg::Kind::rest, 0, 0, 40}})[0]
                      .truth;
  EXPECT_THAT(told(runs), Tells(HasSubstr("run 1"), Help::check_run_and_wiring));
}

TEST(MlRefuses, ADriveWhoseLapsCannotBeTold) {
  simulation::study::Course course{{simulation::study::Leg::Kind::rest, 0, 0, 1}};
  for (int side = 0; side < 32; ++side) {
    course.push_back({simulation::study::Leg::Kind::straight, 0.5, 0, 0});
    course.push_back({simulation::study::Leg::Kind::turn, 0, kPi / 2, 0});
  }
  DriveModel model = astro_drive();
  model.clock_offset_s = 300;
  std::vector<Trajectory> runs = one(course, model);
  std::erase_if(runs[0].wheels, [](const WheelSample& s) { return s.time_s < 40 || s.time_s > 80; });
  EXPECT_THAT(told(runs), Tells(AllOf(HasSubstr("run 7"), HasSubstr("repeats itself")), Help::settle_clock));
}

TEST(MlRefuses, SpinsUnderPositionsThatStandStill) {
  DriveModel model = astro_drive();
  model.headings = false;
  model.lever = {};
  model.clock_offset_s = 7;
  EXPECT_THAT(
      told(one(simulation::study::spin_course(6 * kPi), model)),
      Tells(AllOf(HasSubstr("run 7"), HasSubstr("stand still")), Help::export_orientation_or_mount_off_axis));
}

TEST(MlRefuses, HeadingsThatNeverChange) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  for (BodySample& sample : runs[0].truth) sample.theta_rad = 0.3;
  EXPECT_THAT(told(runs), Tells(AllOf(HasSubstr("run 1"), HasSubstr("heading")),
                                Help::export_orientation_or_check_wiring));
}

TEST(MlRefuses, MirroredAxes) {
  std::vector<Trajectory> runs = squares(astro_drive(), 2);
  for (Trajectory& run : runs)
    for (BodySample& sample : run.truth) {
      sample.y_m = -sample.y_m;
      sample.theta_rad = -sample.theta_rad;
    }
  EXPECT_THAT(refusal(runs), AllOf(HasSubstr("mirrored"), HasSubstr("wheels are exchanged")));
}

TEST(MlRefuses, MirroredAxesWithoutHeadings) {
  DriveModel model = astro_drive();
  model.headings = false;
  std::vector<Trajectory> runs = squares(model, 2);
  for (Trajectory& run : runs)
    for (BodySample& sample : run.truth) sample.y_m = -sample.y_m;
  EXPECT_THAT(refusal(runs), HasSubstr("mirrored"));
}

TEST(MlRefuses, ExchangedWheels) {
  std::vector<Trajectory> runs = squares(astro_drive(), 2);
  for (Trajectory& run : runs)
    for (WheelSample& sample : run.wheels) std::swap(sample.left_m, sample.right_m);
  EXPECT_THAT(told(runs), Tells(HasSubstr("exchanged"), Help::check_wiring));
}

TEST(MlRefuses, HeadingsCountedClockwise) {
  std::vector<Trajectory> runs = squares(astro_drive(), 2);
  for (Trajectory& run : runs)
    for (BodySample& sample : run.truth) sample.theta_rad = -sample.theta_rad;
  EXPECT_THAT(told(runs), Tells(HasSubstr("clockwise"), Help::negate_headings));
}

TEST(MlRefuses, ARobotThatNeverTurned) {
  EXPECT_THAT(told(one(simulation::study::line_course(4))),
              Tells(HasSubstr("never turned"), Help::drive_turns));
}

TEST(MlRefuses, ARobotThatOnlySpun) {
  EXPECT_THAT(told(one(simulation::study::spin_course(6 * kPi))),
              Tells(HasSubstr("on the spot"), Help::drive_lines));
}

TEST(MlRefuses, OneCircleAlone) {
  // Two observables, three unknowns.
  DriveModel model = quiet_drive();
  model.acceleration_mps2 = 100;
  for (const double radius_m : {0.5, 1.0, 1.7})
    for (const double turn_rad : {4 * kPi, -4 * kPi})
      EXPECT_THAT(refusal(one(simulation::study::circle_course(radius_m, turn_rad, 0.3), model)),
                  HasSubstr("move alike"));
}

TEST(MlRefuses, TruthInMillimetres) {
  std::vector<Trajectory> runs = squares(astro_drive(), 1);
  for (BodySample& sample : runs[0].truth) {
    sample.x_m *= 1000;
    sample.y_m *= 1000;
  }
  EXPECT_THAT(told(runs), Tells(HasSubstr("came out, which no robot"), Help::check_units_and_wheels));
}

}  // namespace
}  // namespace astro::calibration
