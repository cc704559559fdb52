#include "host/calibration/preparation/eccentricity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

using simulation::study::DriveModel;

constexpr double kRadius_m = 0.042;

/// Squares of a robot that hardly slips, with the turn of its wheels.
std::vector<Trajectory> drives(std::uint64_t seed) {
  DriveModel model = astro_drive();
  model.noise.K_m = 5e-7;
  model.noise.sigma_theta_rad = 1e-3;
  std::vector<Trajectory> runs = squares(model, 4, 2, seed);
  for (Trajectory& run : runs) run.wheel_turn_m = 2 * std::numbers::pi * kRadius_m;
  return runs;
}

TEST(Eccentricity, IsFoundInTheWheelThatHasIt) {
  std::vector<Trajectory> runs = drives(kSeed);
  for (Trajectory& run : runs)
    for (WheelSample& wheels : run.wheels) wheels.right_m += 3e-4 * std::sin(wheels.right_m / kRadius_m + 1);
  const Eccentricities found = estimate_ml(runs, astro_drive().loaded).eccentricities;
  std::printf("left %.3f +- %.3f mm, right %.3f +- %.3f mm\n", 1e3 * found.left.amplitude_m,
              1e3 * found.left.standard_error_m, 1e3 * found.right.amplitude_m,
              1e3 * found.right.standard_error_m);
  EXPECT_TRUE(found.right.significant);
  EXPECT_NEAR(found.right.amplitude_m, 3e-4, 4 * found.right.standard_error_m);
  EXPECT_FALSE(found.left.significant);
  // The reading leads by sin(angle + 1), so the travel leads most a quarter turn before that is zero.
  ASSERT_EQ(found.right.phases_rad.size(), 4U);
  const double error_rad = 2 * found.right.standard_error_m / 3e-4;  // of one run of four
  for (const double phase_rad : found.right.phases_rad)
    EXPECT_NEAR(std::remainder(phase_rad + 1 + std::numbers::pi / 2, 2 * std::numbers::pi), 0, 4 * error_rad);
}

TEST(Eccentricity, IsNotFoundWhereThereIsNone) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Eccentricities found = estimate_ml(drives(seed), astro_drive().loaded).eccentricities;
    EXPECT_FALSE(found.left.significant) << "seed " << seed;
    EXPECT_FALSE(found.right.significant) << "seed " << seed;
  }
}

// A quarter turn of the reference robot is 2.01 turns of its wheels, so that on all sides of a square both wheels stand alike.
TEST(Eccentricity, IsNotFoundWhereBothWheelsStandAlikeOnAllSides) {
  DriveModel model = astro_drive();
  model.noise.sigma_xy_m = 2e-4;
  model.noise.sigma_theta_rad = 1e-3;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::vector<Trajectory> runs = squares(model, 6, 3, seed);
    for (Trajectory& run : runs) run.wheel_turn_m = std::numbers::pi * 0.072;
    const Eccentricities found = estimate_ml(runs, model.loaded).eccentricities;
    std::printf("left %.3f +- %.3f mm, right %.3f +- %.3f mm\n", 1e3 * found.left.amplitude_m,
                1e3 * found.left.standard_error_m, 1e3 * found.right.amplitude_m,
                1e3 * found.right.standard_error_m);
    EXPECT_FALSE(found.left.significant) << "seed " << seed;
    EXPECT_FALSE(found.right.significant) << "seed " << seed;
  }
}

TEST(Eccentricity, IsNotLookedForWithoutTheTurnOfTheWheels) {
  const DriveModel model = astro_drive();
  const Eccentricities found = estimate_ml(squares(model, 2), model.loaded).eccentricities;
  EXPECT_EQ(found.left.amplitude_m, 0);
  EXPECT_TRUE(std::isinf(found.right.standard_error_m));
  EXPECT_FALSE(found.right.significant);
}

}  // namespace
}  // namespace astro::calibration
