#include "host/lidar/scan_calibration.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/host/lidar/synthetic_room.hpp"

namespace astro::lidar {
namespace {

/// E_d 1.006, b and scale off by 2 and 1 %.
constexpr Robot kWrong{{1.013, 1.007, 0.306}, 2e-6};

ScannedDrive both_ways(const Robot& robot, const Scanner& scanner, std::uint64_t seed, int rounds = 3) {
  SyntheticDrive drive(furnished_room(), robot, scanner, seed);
  drive_both_ways(drive, rounds);
  return drive.recorded();
}

ScanCalibration calibrated(const ScannedDrive& drive) { return calibrate_by_scans({&drive, 1}, kLoaded); }

bool has(const ScanCalibration& found, ScanRemark kind) {
  return std::any_of(found.remarks.begin(), found.remarks.end(),
                     [&](const Remark& remark) { return remark.kind == Kind(kind); });
}

Eigen::Vector3d factor_errors(const ScanCalibration& found, const Robot& robot) {
  return {found.factors.c_r - robot.actual.c_r, found.factors.c_l - robot.actual.c_l,
          found.factors.b_m - robot.actual.b_m};
}

TEST(ScanCalibration, FindsTheFactorsAndWhereTheScannerSits) {
  Scanner scanner;
  scanner.place = {0.08, -0.03, 0.05};
  const ScanCalibration found = calibrated(both_ways(kWrong, scanner, 1));
  EXPECT_TRUE(found.choice.better());
  // 150 m: E_d to 3e-4, b and scale to 2e-3, three standard errors of drives like this.
  EXPECT_NEAR(found.factors.c_r / found.factors.c_l, kWrong.actual.c_r / kWrong.actual.c_l, 1e-3);
  EXPECT_NEAR(found.factors.b_m / kWrong.actual.b_m, 1, 3e-3);
  EXPECT_NEAR((found.factors.c_r + found.factors.c_l) / 2, 1.01, 2e-3);
  EXPECT_NEAR(found.scanner.x_m, 0.08, 0.005);
  EXPECT_NEAR(found.scanner.y_m, -0.03, 0.005);
  EXPECT_NEAR(found.scanner.theta_rad, 0.05, 0.1 / 57.3 * 2);
  EXPECT_LT(found.choice.rms_m, 0.5 * found.choice.loaded_rms_m);
}

TEST(ScanCalibration, KnowsHowFarItIsOff) {
  constexpr int kRobots = 20;
  double sum = 0;
  for (int robot = 0; robot < kRobots; ++robot) {
    const ScanCalibration found =
        calibrated(both_ways(kWrong, {}, static_cast<std::uint64_t>(100 + robot), 2));
    const Eigen::Vector3d error = factor_errors(found, kWrong);
    sum += error.dot(found.covariance.topLeftCorner<3, 3>().inverse() * error) / 3 / kRobots;
  }
  RecordProperty("mean_square_over_expected", std::to_string(sum));
  // 60 squares of normal errors have a mean of 1 +- 0.18; matches share errors of the same walls, which nobody counts.
  EXPECT_LT(sum, 1.6);
  EXPECT_GT(sum, 0.4);
}

TEST(ScanCalibration, TakesFactorsThatHardlyMatterAsFarAsTheDrivesShowThemAndClaimsNoMore) {
  constexpr int kRobots = 12;
  constexpr double kScale = 0.003, kBase = 0.005, kHalfRatio = 0.0005;
  std::mt19937_64 random(50);
  std::normal_distribution<double> normal;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  double sum = 0;
  for (std::uint64_t seed = 200; seed < 200 + kRobots; ++seed) {
    const double scale = 1 + kScale * normal(random), half = kHalfRatio * normal(random);
    const Robot robot{{scale + half, scale - half, kNominalBase_m * (1 + kBase * normal(random))}, 2e-6};
    const ScanCalibration found = calibrated(both_ways(robot, {}, seed, 2));
    const Eigen::Vector3d error = factor_errors(found, robot);
    sum += error.dot(found.covariance.topLeftCorner<3, 3>().inverse() * error) / 3 / kRobots;
    squares += Eigen::Vector3d(error(0) + error(1), error(2), error(0) - error(1)).cwiseAbs2() / kRobots;
  }
  RecordProperty("mean_square_over_expected", std::to_string(sum));
  // 36 squares of normal errors have a mean of 1 +- 0.24.
  EXPECT_LT(sum, 1.6);
  // As loaded they would be off by all of it.
  EXPECT_LT(std::sqrt(squares(0)) / 2, kScale / 2);
  EXPECT_LT(std::sqrt(squares(1)), kNominalBase_m * kBase / 2);
  EXPECT_LT(std::sqrt(squares(2)) / 2, kHalfRatio / 2);
}

TEST(ScanCalibration, OfARobotThatIsRightIsNotBetter) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const ScanCalibration found = calibrated(both_ways({kLoaded, 2e-6}, {}, seed));
    EXPECT_TRUE(found.judged);
    EXPECT_FALSE(has(found, ScanRemark::matcher_biased)) << "seed " << seed;
    EXPECT_FALSE(found.choice.better()) << "seed " << seed;
  }
}

TEST(ScanCalibration, TakesAScannerThatLooksBackwardAndOneOfAnyYaw) {
  for (const double yaw_rad : {3.1, 1.6, -0.8}) {
    Scanner scanner;
    scanner.place = {-0.1, 0.02, yaw_rad};
    const ScanCalibration found = calibrated(both_ways(kWrong, scanner, 5, 2));
    EXPECT_NEAR(wrapped_rad(found.scanner.theta_rad - yaw_rad), 0, 0.005) << yaw_rad;
    EXPECT_NEAR(found.factors.b_m / kWrong.actual.b_m, 1, 4e-3) << yaw_rad;
  }
}

TEST(ScanCalibration, TakesAScannerThatSpinsWhileTheRobotDrives) {
  Scanner scanner;
  scanner.spins = true;
  const ScanCalibration found = calibrated(both_ways(kWrong, scanner, 6));
  EXPECT_NEAR(found.factors.b_m / kWrong.actual.b_m, 1, 3e-3);
  EXPECT_NEAR((found.factors.c_r + found.factors.c_l) / 2, 1.01, 2e-3);
}

TEST(ScanCalibration, TakesAScannerOfHalfATurnWithFewBeams) {
  Scanner scanner;
  scanner.beams = 180;
  scanner.view_rad = std::numbers::pi;
  const ScanCalibration found = calibrated(both_ways(kWrong, scanner, 7));
  EXPECT_TRUE(found.choice.better());
  EXPECT_NEAR(found.factors.b_m / kWrong.actual.b_m, 1, 6e-3);
}

TEST(ScanCalibration, FindsByHowMuchTheStampsAreLate) {
  for (const double late_s : {0.03, -0.03, 0.15}) {
    Scanner scanner;
    scanner.late_s = late_s;
    const ScanCalibration found = calibrated(both_ways(kWrong, scanner, 8));
    EXPECT_NEAR(found.late_s, late_s, 0.005);
    EXPECT_NEAR(found.factors.b_m / kWrong.actual.b_m, 1, 4e-3);
  }
}

/// The same three drives one after the other, whose scans' stamps are late by so much, on wheelbases that are so much longer.
std::vector<ScannedDrive> drives_late(const std::array<double, 3>& late_s,
                                      const std::array<double, 3>& longer = {1, 1, 1}) {
  std::vector<ScannedDrive> drives;
  for (std::size_t i = 0; i < late_s.size(); ++i) {
    Scanner scanner;
    scanner.late_s = late_s[i];
    Robot robot = kWrong;
    robot.actual.b_m *= longer[i];
    ScannedDrive drive = both_ways(robot, scanner, 20 + i, 2);
    const std::int64_t moved_ns = static_cast<std::int64_t>(i) * 1'000'000'000'000;
    drive.origin_ns += moved_ns;
    drive.read_scans = [read = drive.read_scans, moved_ns](const ScanHandler& handle) {
      read([&](Scan scan) {
        scan.time_ns += moved_ns;
        handle(scan);
      });
    };
    drives.push_back(drive);
  }
  return drives;
}

TEST(ScanCalibration, GivesEachDriveAnOffsetOfItsOwnWhereTheScansClockWasSetInBetween) {
  const ScanCalibration set = calibrate_by_scans(drives_late({0.02, 0.02, -0.13}), kLoaded),
                        steady = calibrate_by_scans(drives_late({0.02, 0.02, 0.02}), kLoaded);
  EXPECT_FALSE(has(steady, ScanRemark::clocks_differ));
  EXPECT_TRUE(has(set, ScanRemark::clocks_differ));
  EXPECT_NEAR(set.late_spread_s, 0.15, 0.01) << "twice what one drive says";
  EXPECT_NEAR(set.late_s, -0.03, 0.005) << "the mean";
  // The scans are the same but for their stamps, so the result is, but for where keyframes fall.
  EXPECT_NEAR(set.factors.b_m / steady.factors.b_m, 1, 1e-3);
  EXPECT_NEAR(set.factors.c_r / set.factors.c_l, steady.factors.c_r / steady.factors.c_l, 5e-4);
  EXPECT_LT(set.choice.rms_m, 1.1 * steady.choice.rms_m);
}

TEST(ScanCalibration, DoesNotTakeAWheelbaseOfOneDriveForItsClock) {
  const ScanCalibration found = calibrate_by_scans(drives_late({0, 0, 0}, {1, 1, 1.03}), kLoaded);
  EXPECT_FALSE(has(found, ScanRemark::clocks_differ)) << found.late_spread_s;
  EXPECT_FALSE(has(found, ScanRemark::clock_drifts)) << found.clock_rate;
}

TEST(ScanCalibration, FindsThatTheScansClockRunsAtAnotherRate) {
  const auto calibrated_with = [](double rate) {
    ScannedDrive drive = both_ways(kWrong, {}, 30, 4);
    drive.read_scans = [read = drive.read_scans, rate](const ScanHandler& handle) {
      read([&](Scan scan) {
        scan.time_ns += std::llround(rate * static_cast<double>(scan.time_ns));
        handle(scan);
      });
    };
    return calibrated(drive);
  };
  const ScanCalibration steady = calibrated_with(0);
  EXPECT_FALSE(has(steady, ScanRemark::clock_drifts)) << steady.clock_rate;
  // 190 s: 500 ppm are 95 ms from begin to end, and 30 ppm, quartz, are 6 ms, which does not show.
  for (const double rate : {5e-4, -5e-4}) {
    const ScanCalibration found = calibrated_with(rate);
    EXPECT_TRUE(has(found, ScanRemark::clock_drifts));
    EXPECT_NEAR(found.clock_rate, rate, 5e-5) << "what makes 5 ms in the whole drive";
  }
  for (const double rate : {5e-4, -5e-4, 3e-5}) {
    const ScanCalibration found = calibrated_with(rate);
    // The scans are the same but for their stamps, so the result is, but for where keyframes fall.
    EXPECT_NEAR(found.factors.b_m / steady.factors.b_m, 1, 1e-3) << rate;
    EXPECT_NEAR(found.factors.c_r / found.factors.c_l, steady.factors.c_r / steady.factors.c_l, 5e-4) << rate;
    EXPECT_LT(found.choice.rms_m, 1.1 * steady.choice.rms_m) << rate;
  }
}

TEST(ScanCalibration, KnowsThatARobotBeginsATurnWithinAScan) {
  Scanner scanner;
  scanner.spins = true;
  const ScannedDrive drive = both_ways(kWrong, scanner, 12);
  const ScanCalibration found = calibrated(drive);
  // With the mean motion over each scan its stamps seem to be late by 20 ms.
  EXPECT_NEAR(found.late_s, 0, 0.004);
}

TEST(ScanCalibration, FindsThatGentleArcsTurnAboutAnotherWheelbaseThanSpins) {
  constexpr Robot kTwoBases{{1, 1, 0.3, 0.04}, 2e-6};
  const ScanCalibration found = calibrated(both_ways(kTwoBases, {}, 13, 4));
  const double se = std::sqrt(found.covariance(3, 3));
  EXPECT_LT(se, 0.012);
  EXPECT_NEAR(found.factors.e, 0.04, 3 * se);
  EXPECT_NEAR(found.factors.b_m, 0.3, 3 * std::sqrt(found.covariance(2, 2)));
  EXPECT_GT(found.factors.e, 2 * se);
}

TEST(ScanCalibration, TakesEForNothingWhereTheDrivesDoNotShowIt) {
  SyntheticDrive drive(furnished_room(), {{1, 1, 0.306}, 2e-6}, {}, 14);
  for (int round = 0; round < 8; ++round)
    drive.drive({{0.5, 0, 3}, {0, std::numbers::pi / 2, 2}, {0.5, 0, 3}, {0, -std::numbers::pi / 2, 2}});
  const ScanCalibration found = calibrated(drive.recorded());
  EXPECT_NEAR(found.factors.e, 0, 0.005);
  EXPECT_GT(std::sqrt(found.covariance(3, 3)), 0.015) << "what is known beforehand is 0 +- 0.02";
}

TEST(ScanCalibration, OfAMirrorImageIsRefusedUnlessSomebodySaysThatItIsOne) {
  Scanner scanner;
  scanner.mirrored = true;
  const ScannedDrive drive = both_ways(kWrong, scanner, 9, 2);
  try {
    calibrate_by_scans({&drive, 1}, kLoaded);
    FAIL() << "mirrored scans calibrate";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Kind(ScanProblem::mirrored));
  }
  const ScanCalibration found = calibrate_by_scans({&drive, 1}, kLoaded, true);
  EXPECT_NEAR(found.factors.c_r / found.factors.c_l, kWrong.actual.c_r / kWrong.actual.c_l, 1e-3);
}

TEST(ScanCalibration, ByStraightLinesAloneDoesNotShowTheWheelbaseAndIsNotJudged) {
  SyntheticDrive drive(furnished_room(), {kLoaded, 2e-6}, {}, 10);
  for (int line = 0; line < 30; ++line) drive.drive({line % 2 == 0 ? 0.5 : -0.5, 0, 4});
  const ScanCalibration found = calibrated(drive.recorded());
  EXPECT_TRUE(has(found, ScanRemark::no_turns));
  EXPECT_TRUE(has(found, ScanRemark::mirror_unknown));
  EXPECT_FALSE(has(found, ScanRemark::no_scale));
  EXPECT_FALSE(found.judged);
}

TEST(ScanCalibration, InOnePlaceShowsNeitherTheScannersYawNorTheScale) {
  SyntheticDrive drive(furnished_room(), {{1, 1, 0.306}, 2e-6}, {}, 11);
  drive.drive({{0, 0.6, 60}, {0, -0.6, 60}});
  const ScanCalibration found = calibrated(drive.recorded());
  EXPECT_TRUE(has(found, ScanRemark::no_yaw));
  EXPECT_TRUE(has(found, ScanRemark::no_scale));
  EXPECT_FALSE(has(found, ScanRemark::no_turns));
  // b / S is what turns show.
  EXPECT_NEAR(found.unknowns(kTurn), 0.3 / 0.306, 2e-3);
}

TEST(ScanCalibration, InACorridorIsNotBetter) {
  // Its lengths are off by 1 %, its headings are right, so that it stays between the walls.
  SyntheticDrive drive(corridor(), {{1.01, 1.01, 0.303}, 2e-6}, {}, 12);
  for (int lap = 0; lap < 3; ++lap) drive.drive({{0.5, 0, 20}, {0, 1, std::numbers::pi}});
  const ScanCalibration found = calibrated(drive.recorded());
  EXPECT_TRUE(has(found, ScanRemark::one_direction));
  EXPECT_TRUE(has(found, ScanRemark::no_scale));
  EXPECT_FALSE(found.judged && found.choice.better());
}

TEST(ScanCalibration, ToldOfScansThatAreLost) {
  ScannedDrive drive = both_ways(kWrong, {}, 13);
  const auto read_all = drive.read_scans;
  drive.read_scans = [read_all](const ScanHandler& handle) {
    int index = 0;
    read_all([&](const Scan& scan) {
      if (++index % 200 > 80) handle(scan);  // 16 s of 40 s
    });
  };
  const ScanCalibration found = calibrated(drive);
  EXPECT_TRUE(has(found, ScanRemark::gaps) || has(found, ScanRemark::unmatched));
  EXPECT_NEAR(found.factors.b_m / kWrong.actual.b_m, 1, 6e-3);
}

TEST(ScanCalibration, LeavesOutWhereTheRobotIsKnownToHaveSlipped) {
  SyntheticDrive kicked(furnished_room(), kWrong, {}, 18);
  std::vector<calibration::Slip> slips;
  // All to the same side, as where a wheel slips on one spot; too little for an outlier.
  for (int time = 0; time < 12; ++time) {
    kicked.drive({{0.4, 0, 4}, {0, 0.8, 1.5}, {0.4, 0, 2}, {0, -0.8, 1.5}});
    slips.push_back(kicked.kick(0.02));
    kicked.drive({{0, 1, std::numbers::pi}});
  }
  ScannedDrive drive = kicked.recorded();
  const ScanCalibration unknown = calibrated(drive);
  drive.slips = slips;
  const ScanCalibration known = calibrated(drive);
  EXPECT_EQ(unknown.counts.slipped, 0U);
  EXPECT_EQ(known.counts.slipped, slips.size());
  const double se = std::sqrt(known.covariance(2, 2));
  EXPECT_NEAR(known.factors.b_m, kWrong.actual.b_m, 4 * se);
}

TEST(ScanCalibration, OfScansOfAnotherDriveIsRefused) {
  ScannedDrive drive = both_ways(kWrong, {}, 14, 2);
  SyntheticDrive other(furnished_room(), kWrong, {}, 15);
  for (int leg = 0; leg < 40; ++leg) other.drive({{0.3, -0.9, 2}, {0.5, 0.7, 1}});
  drive.read_scans = other.recorded().read_scans;
  EXPECT_THROW(calibrated(drive), Error);
}

TEST(ScanCalibration, OfScansOfAnotherTimeIsRefused) {
  ScannedDrive drive = both_ways(kWrong, {}, 16, 1);
  drive.origin_ns = 1'000'000'000'000'000;
  try {
    calibrated(drive);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Kind(ScanProblem::no_common_time));
  }
}

}  // namespace
}  // namespace astro::lidar
