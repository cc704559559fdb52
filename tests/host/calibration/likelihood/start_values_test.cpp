#include "host/calibration/likelihood/start_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

using simulation::study::DriveModel;

constexpr double kPi = std::numbers::pi;

std::vector<Unknowns> starts(const std::vector<Trajectory>& runs, const DriveModel& model) {
  return start_values(prepare(runs, model.loaded, true, Density::independent), model.loaded);
}

class LeverYaw : public testing::TestWithParam<double> {};

TEST_P(LeverYaw, StartsAtTheTruthWhereThereIsNoNoise) {
  DriveModel model = quiet_drive();
  model.lever = {0.1, -0.05, GetParam()};
  for (const Unknowns& u : starts(squares(model, 2, 1.7), model)) {
    // Arcs of constant twist stand for 17 ms of accelerating wheels.
    EXPECT_NEAR(u[kCRight], model.actual.c_r, 1e-5);
    EXPECT_NEAR(u[kCLeft], model.actual.c_l, 1e-5);
    EXPECT_NEAR(u[kB], model.actual.b_m, 1e-5);
    EXPECT_NEAR(u[kLeverX], 0.1, 1e-5);
    EXPECT_NEAR(u[kLeverY], -0.05, 1e-5);
    EXPECT_NEAR(std::remainder(u[kLeverYaw] - GetParam(), 2 * kPi), 0, 1e-5);
    // The robot starts where the tracker's frame begins, and stands for a second.
    EXPECT_NEAR(u[kStartX], 0, 2e-5);
    EXPECT_NEAR(u[kStartY], 0, 2e-5);
    EXPECT_NEAR(std::remainder(u[kStartTheta], 2 * kPi), 0, 2e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(InAllQuadrants, LeverYaw, testing::Values(0.4, 1.9, 3.1, -0.7, -2.5, kPi));

TEST(StartValues, FindTheLeverFromPositionsAloneOnAnySideOfTheRobot) {
  DriveModel model = quiet_drive();
  model.actual = model.loaded;  // without headings factors start as loaded; what these are off bends the way
  model.headings = false;
  for (const double x_m : {-0.3, 0.0, 0.3})
    for (const double y_m : {-0.3, 0.0, 0.3}) {
      model.lever = {x_m, y_m, 0};
      for (const Unknowns& u : starts(squares(model, 2, 1.7), model)) {
        EXPECT_NEAR(u[kLeverX], x_m, 1e-5);
        EXPECT_NEAR(u[kLeverY], y_m, 1e-5);
        EXPECT_NEAR(u[kStartX], 0, 2e-5);
        EXPECT_NEAR(u[kStartY], 0, 2e-5);
        EXPECT_NEAR(std::remainder(u[kStartTheta], 2 * kPi), 0, 2e-5);
      }
    }
}

TEST(StartValues, FindTheLeverOfASmallRobotAsThatOfALargeOne) {
  for (const double size : {0.05, 1.0, 20.0}) {
    DriveModel model = quiet_drive();
    model.loaded.b_m *= size;
    model.actual = model.loaded;
    model.headings = false;
    model.lever = {-0.2 * size, -0.1 * size, 0};
    model.speed_mps *= size;
    model.acceleration_mps2 *= size;
    model.noise.K_m *= size;
    model.noise.sigma_xy_m *= size;
    for (const Unknowns& u : starts(squares(model, 2, 0.5 * size), model)) {
      EXPECT_NEAR(u[kLeverX] / size, -0.2, 1e-4);
      EXPECT_NEAR(u[kLeverY] / size, -0.1, 1e-4);
    }
  }
}

TEST(StartValues, KnowTheHeadingOfASpinByTheLeverThatOtherRunsTell) {
  DriveModel model = quiet_drive();
  model.actual = model.loaded;
  model.headings = false;
  model.lever = {-0.2, -0.1, 0};
  std::vector<Trajectory> runs = squares(model, 1, 1.7);
  runs.push_back(
      simulation::study::synthetic_drive(simulation::study::spin_course(6 * kPi), model, "spin", kSeed));
  EXPECT_NEAR(std::remainder(starts(runs, model).back()[kStartTheta], 2 * kPi), 0, 1e-4);
}

TEST(StartValues, FindNoLeverWherePositionsTellNone) {
  DriveModel model = astro_drive();
  model.headings = false;
  for (const simulation::study::Course& course :
       {simulation::study::line_course(3), simulation::study::spin_course(6 * kPi),
        simulation::study::circle_course(0.7, 4 * kPi)}) {
    const std::vector<Trajectory> runs{simulation::study::synthetic_drive(course, model, "run", kSeed)};
    for (const Unknowns& u : starts(runs, model)) {
      EXPECT_LT(std::hypot(u[kLeverX], u[kLeverY]), 0.2);
      EXPECT_TRUE(u.allFinite());
    }
  }
}

TEST(StartNoise, IsThatOfTheTrackerWhateverTheMotion) {
  DriveModel model = astro_drive();
  for (const double times : {1.0, 10.0, 60.0}) {
    model.noise.sigma_xy_m = 5e-4 * times;
    model.noise.sigma_theta_rad = 2.6e-3 * times;
    const std::vector<Trajectory> runs = squares(model, 2);
    const NoiseModel found = start_noise(prepare(runs, model.loaded, true, Density::independent));
    // A median of 10,000 differences that share samples is good to 2 %; 60 Hz of driving add little.
    EXPECT_NEAR(found.sigma_xy_m, model.noise.sigma_xy_m, 0.06 * model.noise.sigma_xy_m);
    EXPECT_NEAR(found.sigma_theta_rad, model.noise.sigma_theta_rad, 0.06 * model.noise.sigma_theta_rad);
  }
}

}  // namespace
}  // namespace astro::calibration
