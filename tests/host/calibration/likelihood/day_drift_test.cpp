#include "host/calibration/likelihood/day_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "tests/host/calibration/ml_drives.hpp"

namespace astro::calibration {
namespace {

constexpr double kDay_s = 86400;

/// Two squares in each of six folders, with `apart_s` from one to the next if that is known. Their wheel ratios have a standard
/// deviation of `ratio`.
MlEstimate six_folders(double ratio, std::optional<double> apart_s) {
  simulation::study::DriveModel model = astro_drive();
  model.truth_rate_hz = 10;
  model.count_rate_hz = 20;
  model.noise.K_m = 1e-7;
  const WheelFactors mean = model.actual;
  std::vector<Trajectory> drives;
  std::uint64_t folder = 0;
  for (const double off : {-1.2, 0.4, 1.3, -0.9, 1.0, -0.6}) {
    model.actual.c_r = mean.c_r * (1 + ratio * off / 2);
    model.actual.c_l = mean.c_l * (1 - ratio * off / 2);
    for (Trajectory& drive : squares(model, 2, 3, kSeed + folder)) {
      drive.session = "folder " + std::to_string(folder);
      if (apart_s) drive.started_s = 1.7e9 + static_cast<double>(folder) * *apart_s;
      drive.name = drive.session + " " + drive.name;
      drives.push_back(drive);
    }
    ++folder;
  }
  MlOptions options;
  options.clock_known = true;
  return estimate_ml(drives, model.loaded, options);
}

TEST(DayDrift, OfOneDayIsThatOfOtherRobots) {
  const DayDrift usual;
  MlOptions options;
  options.clock_known = true;
  const MlEstimate found = estimate_ml(squares(quiet_drive(), 2), quiet_drive().loaded, options);
  EXPECT_EQ(found.drift.days, 1);
  EXPECT_EQ(found.drift.E_d, usual.E_d);
  // Without noise of its own it is off on another day by the drift alone.
  const MlErrors se = errors_of(found.covariance_another_day, found.factors);
  EXPECT_NEAR(se.E_d, usual.E_d * found.E_d(), 0.02 * usual.E_d);
  EXPECT_NEAR(se.scale, usual.scale * found.scale(), 0.02 * usual.scale);
}

// Six days count beside the four of other robots: 2.2e-3, if each day were known exactly. A fit has one set of factors for all days,
// so a part of what they differ by passes for slip.
// Drives of one afternoon in several folders say nothing of another day, and folders without dates may be of one afternoon.
TEST(DayDrift, OfSessionsThatAreNoDaysApartIsThatOfOtherRobots) {
  const DayDrift usual;
  for (const std::optional<double>& apart_s : {std::optional<double>(600), std::optional<double>()}) {
    const MlEstimate found = six_folders(0, apart_s);
    EXPECT_EQ(found.sessions.size(), 6U);
    EXPECT_EQ(found.drift.days, 1);
    EXPECT_EQ(found.drift.E_d, usual.E_d);
    // All were driven on one day, so that none of what that day is off by averages out.
    const MlErrors se = errors_of(found.covariance_another_day, found.factors);
    EXPECT_NEAR(se.E_d, std::hypot(found.se.E_d, usual.E_d * found.E_d()), 1e-5);
  }
}

TEST(DayDrift, OfSeveralDaysFollowsTheirSpread) {
  const DayDrift usual;
  const MlEstimate spread = six_folders(2e-3, kDay_s), alike = six_folders(0, kDay_s);
  std::printf("E_d from day to day: %.2e and %.2e\n", spread.drift.E_d, alike.drift.E_d);
  EXPECT_EQ(spread.drift.days, 6);
  EXPECT_GT(spread.drift.E_d, 1.4e-3);
  EXPECT_LT(spread.drift.E_d, 2.4e-3);
  EXPECT_LT(alike.drift.E_d, usual.E_d);
  EXPECT_GT(alike.drift.E_d, 0.5 * usual.E_d);
  EXPECT_LT(spread.drift.b_over_scale, 2 * usual.b_over_scale) << "only the ratio changed";
  // Of the other day, and a sixth of that of the days driven.
  const MlErrors se = errors_of(spread.covariance_another_day, spread.factors);
  EXPECT_NEAR(se.E_d, spread.drift.E_d * std::sqrt(0.5 * (1 + 1.0 / 6)) * spread.E_d(), 2e-4);
}

}  // namespace
}  // namespace astro::calibration
