#include "host/calibration/gyro/gyro_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/host/calibration/gyro/gyro_drives.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/thorough.hpp"

namespace astro::calibration {
namespace {

/// Errors of many robots, in their unit and over the errors that were stated.
struct Errors {
  double squares = 0, normalised = 0;
  int count = 0;

  void add(double error, double se) {
    squares += error * error;
    normalised += error * error / (se * se);
    ++count;
  }
  double rms() const { return std::sqrt(squares / count); }
  double chi_square() const { return normalised / count; }
};

/// Bounds of chi-square over its degrees of freedom: those claimed where many robots are tried, otherwise what 0.1 % of honest sets are
/// beyond on either side (16 robots: 3.94 and 39.3; 8 robots: 0.86 and 26.1).
struct HonestErrors {
  double least, most;
};
HonestErrors honest(int robots) {
  if (support::thorough()) return {0.8, 1.25};
  return robots == 16 ? HonestErrors{3.94 / 16, 39.3 / 16} : HonestErrors{0.86 / 8, 26.1 / 8};
}

TEST(GyroCalibration, FindsScaleAndLagOfManyRobotsAndKnowsHowWell) {
  const int robots = support::how_often(16, 128);
  Errors scale, lag, product;
  const simulation::study::DriveModel robot = gyro_robot();
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(robots); ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> even(-1, 1);
    GyroModel gyro;
    gyro.scale = (1 + 0.01 * even(random)) * (seed % 4 == 0 ? -1 : 1);
    gyro.lag_s = 0.01 + 0.01 * even(random);
    gyro.bias_radps = 0.05 * even(random);
    const std::vector<GyroDrive> drives = gyro_squares(gyro, seed);
    const GyroAgainstWheels found = compare_gyro(drives, robot.actual);
    const auto by_truth = gyro_scale_by_truth(drives, robot.actual, found);
    ASSERT_TRUE(by_truth);
    EXPECT_TRUE(found.slips.empty()) << seed;
    scale.add(by_truth->scale - gyro.scale, by_truth->se);
    lag.add(found.lag_s - gyro.lag_s, found.lag_se_s);
    product.add(found.product - gyro.scale, found.product_se);
  }
  std::printf(
      "of %d robots, rms error and chi-square: scale %.4f %% %.2f, lag %.3f ms %.2f, product %.4f %% %.2f\n",
      robots, 100 * scale.rms(), scale.chi_square(), 1000 * lag.rms(), lag.chi_square(), 100 * product.rms(),
      product.chi_square());
  EXPECT_LT(scale.rms(), 5e-4);
  for (const Errors* errors : {&scale, &lag, &product}) {
    EXPECT_GT(errors->chi_square(), honest(robots).least);
    EXPECT_LT(errors->chi_square(), honest(robots).most);
  }
  EXPECT_LT(lag.rms(), 5e-3) << "by more than that slips seem to be seen at every spin";
}

TEST(GyroCalibration, FindsTheLagOfASlowSensor) {
  const std::vector<GyroDrive> drives = gyro_squares({.scale = 1.004, .lag_s = 0.18}, 3);
  const GyroAgainstWheels found = compare_gyro(drives, gyro_robot().actual);
  EXPECT_NEAR(found.lag_s, 0.18, 4 * found.lag_se_s);
  EXPECT_LT(found.lag_se_s, 2e-3);
}

TEST(GyroCalibration, WheelsAndGyroAloneShowTheScaleTimesTheLoadedWheelbaseOverTheTrueOne) {
  const simulation::study::DriveModel robot = gyro_robot();
  WheelFactors loaded = robot.actual;
  loaded.b_m *= 1.02;
  const std::vector<GyroDrive> drives = gyro_squares({.scale = 0.99}, 5);
  const GyroAgainstWheels found = compare_gyro(drives, loaded);
  EXPECT_NEAR(found.product, 0.99 * 1.02, 4 * found.product_se);
  EXPECT_LT(found.product_se, 2e-3);
}

TEST(GyroCalibration, AWheelThatIsLargerThanTheFactorsSayIsNotTakenForTheScale) {
  const simulation::study::DriveModel robot = gyro_robot();
  WheelFactors loaded = robot.actual;
  loaded.c_r *= 1.004;
  // Squares one way round: the way and the turn go together.
  std::vector<GyroDrive> drives = gyro_squares({}, 6);
  for (std::size_t i = drives.size(); i-- > 0;)
    if (i % 2 == 1) drives.erase(drives.begin() + static_cast<std::ptrdiff_t>(i));
  const GyroAgainstWheels found = compare_gyro(drives, loaded);
  EXPECT_NEAR(found.product, 1, 4 * found.product_se);
}

TEST(GyroCalibration, WheelsAndGyroAloneShowHowTheWheelsDifferAndKnowHowWell) {
  Errors difference;
  const int robots = support::how_often(8, 128);
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(robots); ++seed) {
    const double wrong = 0.004 * std::sin(static_cast<double>(seed));
    WheelFactors loaded = gyro_robot().actual;
    loaded.c_r *= 1 + wrong;
    const GyroAgainstWheels found =
        compare_gyro(gyro_squares({.scale = seed % 2 == 0 ? -0.99 : 1.01}, seed), loaded);
    difference.add(found.difference - (1 / (1 + wrong) - 1), found.difference_se);
  }
  std::printf("of %d robots, rms error %.2e, chi-square %.2f\n", robots, difference.rms(),
              difference.chi_square());
  EXPECT_LT(difference.rms(), 4e-4) << "the slip of ten squares";
  EXPECT_GT(difference.chi_square(), honest(robots).least);
  EXPECT_LT(difference.chi_square(), honest(robots).most);
}

TEST(GyroCalibration, FindsAKickWithItsTimeAndPlaceAndIsNotMovedByIt) {
  constexpr double kKick_rad = 5 * kDegree_rad, kAt_s = 9;
  const GyroModel gyro{.scale = 1.005, .lag_s = 0.008};
  std::vector<GyroDrive> drives = gyro_squares(gyro, 7);
  const GyroAgainstWheels before = compare_gyro(drives, gyro_robot().actual);
  drives[4] = with_gyro(squares(gyro_robot(), 10, 2, 7)[4], gyro, 704, {kAt_s, kKick_rad});
  const GyroAgainstWheels found = compare_gyro(drives, gyro_robot().actual);
  ASSERT_EQ(found.slips.size(), 1U);
  const UnseenTurn& unseen = found.slips[0];
  const Slip& slip = unseen.slip;
  EXPECT_EQ(unseen.drive, 4U);
  EXPECT_LT(slip.begin_s, kAt_s);
  EXPECT_GT(slip.end_s, kAt_s + 0.1);
  EXPECT_LT(slip.end_s - slip.begin_s, 1) << "two windows and the kick itself";
  EXPECT_NEAR(slip.turn_rad, kKick_rad, 0.3 * kDegree_rad) << "noise of tyres over the window";
  EXPECT_GT(std::hypot(unseen.place.x_m, unseen.place.y_m), 0.5) << "on its way";
  EXPECT_NEAR(found.product, before.product, found.product_se);
}

/// Turns so many times as each of `turns` says, one after the other, with two seconds of rest before and after each, and the headings
/// at the ends as somebody who lays the robot against a wall shows them.
GyroDrive turning(const GyroModel& gyro, const std::vector<int>& turns, std::mt19937_64& random,
                  double aligned_rad, std::vector<KnownHeading>& headings) {
  constexpr double kStep_s = 0.01, kRate_radps = 1.8, kRest_s = 2, kTurn_rad = 2 * std::numbers::pi;
  std::normal_distribution<double> normal;
  GyroDrive drive;
  double time_s = 0, off_rad = aligned_rad * normal(random), bias_radps = gyro.bias_radps, told_rad = 0;
  headings = {{kStep_s, 0}};
  const auto go = [&](double turn_rad, double span_s) {
    const auto steps = static_cast<int>(std::ceil(span_s / kStep_s));
    for (int i = 0; i < steps; ++i) {
      time_s += kStep_s;
      bias_radps += gyro.bias_walk * std::sqrt(kStep_s) * normal(random);
      drive.rates.push_back({time_s, gyro.scale * turn_rad / steps / kStep_s + bias_radps +
                                         gyro.random_walk_radprs / std::sqrt(kStep_s) * normal(random)});
    }
  };
  for (const int whole : turns) {
    const double next_rad = aligned_rad * normal(random), turn_rad = kTurn_rad * whole;
    go(0, kRest_s);
    go(turn_rad + next_rad - off_rad, std::abs(turn_rad) / kRate_radps);
    go(0, kRest_s);
    off_rad = next_rad;
    told_rad += turn_rad;
    headings.push_back({time_s, told_rad});
  }
  return drive;
}

// sd(s) = s_w sqrt(3 / 2) / (10 pi) of five turns each way between three alignments, and 0.02 % of the gyro's own.
// Chi-square over its degrees of freedom scatters by 0.07 between sets of 400 robots.
TEST(GyroByHeadings, HasAScaleToATenthOfAPercentAfterFiveTurnsEachWay) {
  for (const double aligned_deg : {0.5, 1.0}) {
    Errors scale;
    std::mt19937_64 random(1);
    for (int robot = 0; robot < 400; ++robot) {
      const GyroModel gyro{.scale = robot % 4 == 0 ? -0.99 : 1.01};
      std::vector<std::vector<KnownHeading>> headings(1);
      const std::vector<GyroDrive> drives{
          turning(gyro, {5, -5}, random, aligned_deg * kDegree_rad, headings[0])};
      GyroAgainstWheels compared;
      compared.product = gyro.scale * 1.02;
      compared.noise.gyro_rad2ps = gyro.random_walk_radprs * gyro.random_walk_radprs;
      const auto found = gyro_scale_by_headings(drives, headings, aligned_deg * kDegree_rad, compared);
      ASSERT_TRUE(found);
      scale.add(found->scale.scale - gyro.scale, found->scale.se);
    }
    std::printf(
        "five turns each way, aligned to %.1f degrees: rms error of the scale %.4f %%, chi-square %.2f\n",
        aligned_deg, 100 * scale.rms(), scale.chi_square());
    EXPECT_LT(scale.rms(), 1e-3);
    EXPECT_GT(scale.chi_square(), 0.8);
    EXPECT_LT(scale.chi_square(), 1.25);
  }
}

TEST(GyroByHeadings, FindsTheBiasOfEachDriveAndSkipsWhatAGapHides) {
  std::mt19937_64 random(2);
  const GyroModel gyro{.scale = 1.01, .bias_radps = 0.03};
  std::vector<std::vector<KnownHeading>> headings(2);
  std::vector<GyroDrive> drives{turning(gyro, {3, -3, 3, -3}, random, 0, headings[0]),
                                turning(gyro, {3, -3}, random, 0, headings[1])};
  drives[0].name = "first";
  // The gyro was silent for a second of the second stretch, in which the robot turned.
  std::erase_if(drives[0].rates, [&](const YawRate& rate) {
    return rate.time_s > headings[0][1].time_s + 5 && rate.time_s < headings[0][1].time_s + 6;
  });
  GyroAgainstWheels compared;
  compared.noise.gyro_rad2ps = gyro.random_walk_radprs * gyro.random_walk_radprs;
  const auto found = gyro_scale_by_headings(drives, headings, 1e-3, compared);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->scale.scale, gyro.scale, 4 * found->scale.se);
  ASSERT_EQ(found->biases.size(), 2U);
  EXPECT_EQ(found->biases[0].drive, "first");
  for (const GyroBias& bias : found->biases) {
    EXPECT_NEAR(bias.radps, gyro.bias_radps, 4 * bias.se_radps);
    EXPECT_LT(bias.se_radps, 1e-3);
  }
  EXPECT_FALSE(gyro_scale_by_headings(drives, std::vector<std::vector<KnownHeading>>(2), 1e-3, compared));
}

TEST(GyroCalibration, RefusesWhatShowsNothing) {
  const WheelFactors factors = gyro_robot().actual;
  std::vector<GyroDrive> drives = gyro_squares({}, 8);
  const auto kind = [&] { return support::told_by([&] { compare_gyro(drives, factors); }).kind; };
  for (GyroDrive& drive : drives)
    for (std::size_t i = 0; i < drive.rates.size(); ++i)
      drive.rates[i].rate_radps = 0.5 * std::sin(0.7 * static_cast<double>(i * i % 1009));
  EXPECT_EQ(kind(), Kind(GyroProblem::nothing_alike)) << "that of another robot";
  for (GyroDrive& drive : drives) drive.rates.clear();
  EXPECT_EQ(kind(), Kind(GyroProblem::no_rates));
  drives = {with_gyro(
      simulation::study::synthetic_drive(simulation::study::line_course(3), gyro_robot(), "line", 1), {}, 1)};
  EXPECT_EQ(kind(), Kind(GyroProblem::no_turns));
}

}  // namespace
}  // namespace astro::calibration
