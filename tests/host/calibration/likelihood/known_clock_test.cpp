#include <gtest/gtest.h>

#include <numbers>

#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

/// Squares whose truth is late by so much.
std::vector<Trajectory> late_squares(double late_s) {
  simulation::study::DriveModel model = quiet_drive();
  model.clock_offset_s = late_s;
  return squares(model, 2, 1);
}

TEST(KnownClock, IsNotEstimatedHoweverMuchTheDataWouldLikeIt) {
  // 5 ms are 1.5 mm at 0.3 m/s, much more than the noise.
  MlOptions known;
  known.clock_known = true;
  const std::vector<Trajectory> late = late_squares(0.005);
  const MlEstimate held = estimate_ml(late, quiet_drive().loaded, known);
  EXPECT_EQ(held.sessions.front().clock_skew, 0);
  for (const RunFit& run : held.runs) EXPECT_EQ(run.clock_offset_s, 0) << run.name;
  const MlEstimate free = estimate_ml(late, quiet_drive().loaded);
  for (const RunFit& run : free.runs) EXPECT_NEAR(run.clock_offset_s, 0.005, 1e-4) << run.name;
  EXPECT_GT(held.noise.K_m, 5 * free.noise.K_m) << "what the clock must not explain is slip";
}

TEST(NoiseModel, UnlessToldOtherwiseIsThatOfTheThesisRobotUnderMotionCapture) {
  const NoiseModel noise;
  EXPECT_DOUBLE_EQ(noise.K_m, 2.645e-6);
  EXPECT_DOUBLE_EQ(noise.sigma_xy_m, 0.0005);
  EXPECT_NEAR(noise.sigma_theta_rad * 180 / std::numbers::pi, 0.15, 0.002);
}

}  // namespace
}  // namespace astro::calibration
