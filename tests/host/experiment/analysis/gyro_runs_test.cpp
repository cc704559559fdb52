#include "host/experiment/analysis/gyro_runs.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/experiment/analysis/trajectories.hpp"
#include "tests/host/calibration/gyro/gyro_drives.hpp"
#include "tests/support/base/remarks.hpp"

// The gyro of recorded runs.
namespace astro::experiment {
namespace {

using calibration::GyroDrive;
using calibration::GyroModel;

constexpr double kWheelDiameter_m = 0.072, kWheelCounts = 2803.2;
constexpr std::int64_t kFirst_us = 5'000'000;

std::int64_t micros(double time_s) { return kFirst_us + std::llround(1e6 * time_s); }

/// As an importer makes a run: the tracker's clock is ahead by `ahead_s`.
recording::Run run_of(const GyroDrive& drive, double ahead_s) {
  recording::Run run;
  run.info.truth_source = "file";
  run.info.truth_clock = "tracker";
  run.info.parameters = {{"wheel_diameter", kWheelDiameter_m},
                         {"counts_per_motor_rev", kWheelCounts},
                         {"gear_numerator", 1},
                         {"gear_denominator", 1},
                         {"c_R", 1},
                         {"c_L", 1},
                         {"b", 0.29},
                         {"e", 0},
                         {"kappa0", 0.12}};
  for (const calibration::WheelSample& sample : drive.wheels) {
    recording::OdometrySample odometry;
    odometry.time_us = micros(sample.time_s);
    odometry.left_counts = static_cast<std::int32_t>(std::lround(sample.left_m / drive.count_m));
    odometry.right_counts = static_cast<std::int32_t>(std::lround(sample.right_m / drive.count_m));
    run.odometry.push_back(odometry);
  }
  for (const calibration::BodySample& body : drive.truth)
    run.truth.push_back({micros(body.time_s + ahead_s), body.x_m, body.y_m, body.theta_rad});
  for (const calibration::YawRate& rate : drive.rates)
    run.yaw_rates.push_back({micros(rate.time_s), rate.rate_radps});
  return run;
}

RunSet runs_of(const std::vector<GyroDrive>& drives, double ahead_s = 0.3) {
  RunSet set;
  for (const GyroDrive& drive : drives) {
    set.runs.push_back(run_of(drive, ahead_s));
    set.names.push_back(drive.name);
  }
  return set;
}

Calibration calibrated(const RunSet& set) {
  return calibrate(Recordings(set), {MethodChoice::Family::ml, {}});
}

TEST(GyroRuns, GiveTheScaleByATrackerWhoseClockIsItsOwn) {
  const GyroModel gyro{.scale = -1.006, .lag_s = 0.012};
  const RunSet set = runs_of(calibration::gyro_squares(gyro, 11));
  const auto found = calibrate_gyro(set, calibrated(set));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->by, GyroReference::truth);
  EXPECT_NEAR(found->scale.scale, gyro.scale, 4 * found->scale.se);
  EXPECT_LT(found->scale.se, 5e-4);
  EXPECT_NEAR(found->against_wheels.lag_s, gyro.lag_s, 4 * found->against_wheels.lag_se_s);
  EXPECT_THAT(slip_sentences(found->against_wheels, found->names), testing::IsEmpty());
  EXPECT_THAT(gyro_sentence(*found), testing::HasSubstr("clockwise instead of counter-clockwise"));
  const nlohmann::json json = to_json(*found);
  EXPECT_EQ(json["sign"], -1);
  EXPECT_EQ(json["biases"].size(), 10U);
}

TEST(GyroRuns, DoNotChangeTheFactorsOfTheWheels) {
  RunSet set = runs_of(calibration::gyro_squares({}, 12));
  const Calibration with = calibrated(set);
  for (recording::Run& run : set.runs) run.yaw_rates.clear();
  const Calibration without = calibrated(set);
  EXPECT_EQ(with.factors.c_r, without.factors.c_r);
  EXPECT_EQ(with.factors.c_l, without.factors.c_l);
  EXPECT_EQ(with.factors.b_m, without.factors.b_m);
  EXPECT_FALSE(calibrate_gyro(set, without));
}

TEST(GyroRuns, ShowWithoutTruthHowTheWheelsDifferAndTheWheelbaseAsWellAsTheScaleIsKnown) {
  const GyroModel gyro{.scale = -1.004};
  RunSet set = runs_of(calibration::gyro_squares(gyro, 15));
  for (recording::Run& run : set.runs) run.truth.clear();
  const GyroAlone found = factors_by_gyro(set, 0.005);
  const calibration::WheelFactors actual = calibration::gyro_robot().actual;
  EXPECT_NEAR(found.factors.c_r / found.factors.c_l, actual.c_r / actual.c_l, 4 * found.E_d_se);
  EXPECT_LT(found.E_d_se, 5e-4);
  EXPECT_DOUBLE_EQ(found.factors.c_r + found.factors.c_l, 2) << "what does not show stays as it was loaded";
  const double scale = (actual.c_r + actual.c_l) / 2;
  EXPECT_NEAR(found.factors.b_m, actual.b_m / scale, 2 * found.b_se_m);
  EXPECT_NEAR(found.b_se_m, 0.005 * found.factors.b_m, 0.0005 * found.factors.b_m)
      << "the gyro's scale is most of it";
  EXPECT_EQ(to_json(found)["slips"].size(), 0U);
  for (recording::Run& run : set.runs) run.yaw_rates.clear();
  EXPECT_EQ(support::told_by([&] { factors_by_gyro(set, 0.005); }).kind,
            Kind(calibration::GyroProblem::no_rates));
}

TEST(GyroRuns, TellWhereTheRobotWasKicked) {
  const GyroModel gyro;
  std::vector<GyroDrive> drives = calibration::gyro_squares(gyro, 13);
  drives[2] = calibration::with_gyro(calibration::squares(calibration::gyro_robot(), 10, 2, 13)[2], gyro,
                                     1302, {9, 5 * calibration::kDegree_rad});
  const RunSet set = runs_of(drives);
  const auto found = calibrate_gyro(set, calibrated(set));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->against_wheels.slips.size(), 1U);
  EXPECT_THAT(slip_sentences(found->against_wheels, found->names).front(),
              testing::StartsWith(drives[2].name + ": by its gyro the robot turned by "));
}

TEST(GyroRuns, LeaveTheStretchesOfKicksOutOfTheFit) {
  const GyroModel gyro;
  std::vector<GyroDrive> drives = calibration::gyro_squares(gyro, 14);
  const Calibration calm = calibrated(runs_of(drives));
  const std::vector<calibration::Trajectory> runs =
      calibration::squares(calibration::gyro_robot(), 10, 2, 14);
  for (const std::size_t kicked : {1U, 4U, 8U})
    drives[kicked] = calibration::with_gyro(runs[kicked], gyro, 1400 + kicked,
                                            {7 + static_cast<double>(kicked), 12 * calibration::kDegree_rad});
  RunSet set = runs_of(drives);
  const Calibration with = calibrated(set);
  for (recording::Run& run : set.runs) run.yaw_rates.clear();
  const Calibration without = calibrated(set);
  const auto off = [&](const Calibration& found) {
    return std::hypot((found.factors.c_r - calm.factors.c_r) / calm.se.c_r,
                      (found.factors.c_l - calm.factors.c_l) / calm.se.c_l,
                      (found.factors.b_m - calm.factors.b_m) / calm.se.b_m);
  };
  const auto jolts = [](const Calibration& found) {
    std::size_t count = 0;
    for (const calibration::RunFit& run : found.ml()->estimate.runs) count += run.slip_events.size();
    return count;
  };
  fmt::print("off by {:.2f} standard errors with a gyro, by {:.2f} without one\n", off(with), off(without));
  EXPECT_LT(off(with), 0.5) << "three seconds of ten drives are left out";
  EXPECT_EQ(jolts(with), 0U) << "nothing is left to find";
  EXPECT_GE(jolts(without), 3U);
}

}  // namespace
}  // namespace astro::experiment
