#include "host/import/scans/carmen_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "host/base/files.hpp"
#include "host/import/scans/carmen_messages.hpp"
#include "host/lidar/scan_calibration.hpp"
#include "tests/host/import/scans/carmen_text.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::importing {
namespace {

lidar::SyntheticDrive driven(int rounds) {
  lidar::Scanner scanner;
  scanner.beams = 180;
  scanner.view_rad = std::numbers::pi;
  scanner.period_s = 0.4;
  lidar::SyntheticDrive drive(lidar::furnished_room(), {{1.013, 1.007, 0.306}, 2e-6}, scanner, 21);
  lidar::drive_both_ways(drive, rounds);
  return drive;
}

class CarmenLogTest : public testing::Test {
 protected:
  CarmenLog read(const std::string& text) {
    const std::filesystem::path path = folder_.path() / "drive.log";
    std::ofstream(path) << text;
    return read_carmen_log(path, lidar::kNominalBase_m);
  }
  test::TemporaryFolder folder_;
};

TEST_F(CarmenLogTest, GivesTheSameWheelsRawAndCorrected) {
  const lidar::SyntheticDrive drive = driven(1);
  const CarmenLog raw = read(carmen_text(drive, false)), corrected = read(carmen_text(drive, true));
  EXPECT_FALSE(raw.corrected);
  EXPECT_TRUE(corrected.corrected);
  const calibration::WheelSample end = drive.recorded().wheels.back();
  for (const CarmenLog* log : {&raw, &corrected}) {
    // The log ends at the last scan, less than 0.8 s before the drive, in an arc of up to 0.52 m/s.
    EXPECT_NEAR(log->drive.wheels.back().left_m, end.left_m, 0.8 * 0.52);
    EXPECT_NEAR(log->drive.wheels.back().right_m, end.right_m, 0.8 * 0.52);
  }
  EXPECT_NEAR(raw.drive.wheels.back().left_m, corrected.drive.wheels.back().left_m, 2e-3);
  EXPECT_NEAR(raw.drive.wheels.back().right_m, corrected.drive.wheels.back().right_m, 2e-3);
}

/// A raw log whose lines of odometry repeat the scans' poses.
std::string scans_before_odometry(const std::string& raw, bool between) {
  std::istringstream lines(raw);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (between || !line.starts_with("ODOM")) text += line + '\n';
    if (!line.starts_with("FLASER")) continue;
    std::istringstream words(line);
    const std::vector<std::string> all{std::istream_iterator<std::string>(words), {}};
    const std::size_t pose = 2 + std::stoul(all[1]);
    text += "ODOM " + all[pose] + ' ' + all[pose + 1] + ' ' + all[pose + 2] + " 0 0 0 1 host 1\n";
  }
  return text;
}

TEST_F(CarmenLogTest, KeepsTheMotionOfARawLogWhoseOdometryRepeatsItsScans) {
  const std::string raw = carmen_text(driven(1), false);
  const CarmenLog plain = read(raw);
  for (const bool between : {false, true}) {
    const CarmenLog log = read(scans_before_odometry(raw, between));
    EXPECT_FALSE(log.corrected) << between;
    EXPECT_NEAR(log.way_m, plain.way_m, 0.01 * plain.way_m) << between;
    EXPECT_NEAR(log.drive.wheels.back().left_m, plain.drive.wheels.back().left_m, 0.02) << between;
  }
}

TEST_F(CarmenLogTest, CalibratesTheRobotThatDroveIt) {
  for (const bool corrected : {false, true}) {
    const CarmenLog log = read(carmen_text(driven(3), corrected));
    const lidar::ScanCalibration found = lidar::calibrate_by_scans({&log.drive, 1}, lidar::kLoaded);
    EXPECT_TRUE(found.choice.better());
    EXPECT_NEAR(found.factors.c_r / found.factors.c_l, 1.013 / 1.007, 1.5e-3);
    EXPECT_NEAR(found.factors.b_m, 0.306, 0.002);
    EXPECT_TRUE(std::isnan(found.late_se_s)) << "its times mean nothing";
  }
}

TEST_F(CarmenLogTest, WithScansThatAreLostHasTheSameWheels) {
  const std::string text = carmen_text(driven(1), true);
  std::istringstream lines(text);
  std::string half;
  int scans = 0;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("FLASER") || ++scans % 3 != 0) half += line + '\n';
  const CarmenLog all = read(text), some = read(half);
  EXPECT_LT(some.scans, all.scans);
  EXPECT_NEAR(some.drive.wheels.back().left_m, all.drive.wheels.back().left_m, 1e-9);
  EXPECT_NEAR(some.drive.wheels.back().right_m, all.drive.wheels.back().right_m, 1e-9);
}

TEST_F(CarmenLogTest, OfBeamsThatSawNothingLeavesOutTheGreatestRange) {
  std::size_t beyond = 0;
  read(
      "ODOM 0 0 0 0 0 0 1 h 1\nODOM 1 0 0 0 0 0 1 h 1\n"
      "FLASER 4 1.0 8.1 8.1 2.0 1 0 0 1 0 0 1 h 1\n")
      .drive.read_scans([&](const lidar::Scan& scan) {
        for (const float range_m : scan.ranges_m)
          if (!(static_cast<double>(range_m) < scan.range_max_m)) ++beyond;
      });
  EXPECT_EQ(beyond, 2u);
}

TEST_F(CarmenLogTest, OfBeamsThatSawNothingLeavesOutTheGreatestRangeInSpiteOfAGlitchBeyond) {
  std::string text = "ODOM 0 0 0 0 0 0 1 h 1\nODOM 1 0 0 0 0 0 1 h 1\n";
  constexpr int kScans = 20, kSeen = 80;
  for (int scan = 0; scan < kScans; ++scan) {
    text += "FLASER 100 " + std::string(scan == 0 ? "8.01" : "8.00");
    for (int beam = 1; beam < 100; ++beam)
      text += beam <= kSeen ? fmt::format(" {}.{:02}", 1 + beam % 6, beam) : " 8.00";
    text += " 1 0 0 1 0 0 1 h 1\n";
  }
  int within = 0;
  read(text).drive.read_scans([&](const lidar::Scan& scan) {
    for (const float range_m : scan.ranges_m)
      if (static_cast<double>(range_m) < scan.range_max_m) ++within;
  });
  EXPECT_EQ(within, kScans * kSeen);
}

TEST_F(CarmenLogTest, LeavesOutDamagedLinesAndSaysHowMany) {
  const std::string good =
      "ODOM 0 0 0 0 0 0 1 h 1\nODOM 0.1 0 0 0 0 0 1 h 1\nFLASER 2 1 2 0 0 0 0.1 0 0 1 h 1\n";
  const CarmenLog log = read(good +
                             "FLASER 5 1 2\nFLASER 1e9 1\nFLASER -3 1\nODOM 1 nan 2\nODOM\nODOM x y "
                             "z\nFLASER 2 1 2 0 0 0 0.1 0\nFLASER 3 1 2 3 0 0");
  EXPECT_EQ(log.scans, 1u);
  EXPECT_EQ(log.odometry, 2u);
  EXPECT_EQ(log.damaged, 7u);  // "ODOM" alone is no message
}

TEST_F(CarmenLogTest, WithoutOdometryOrScansIsRefused) {
  const auto kind_of = [&](const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      return error.kind();
    }
    return Kind{};
  };
  EXPECT_EQ(kind_of("FLASER 2 1 2 0 0 0 0.1 0 0 1 h 1\n"), Kind(ScanFileProblem::no_odometry));
  EXPECT_EQ(kind_of("ODOM 0 0 0 0 0 0 1 h 1\nODOM 1 0 0 0 0 0 1 h 1\n"), Kind(ScanFileProblem::no_scans));
}

TEST_F(CarmenLogTest, IsRecognisedByItsLines) {
  EXPECT_TRUE(is_carmen_log(std::string_view("# a comment\nODOM 0 0 0 0 0 0 1 h 1\n")));
  EXPECT_FALSE(is_carmen_log(std::string_view("time,x,y\n0,1,2\n")));
  EXPECT_FALSE(is_carmen_log(std::string_view("")));
}

TEST_F(CarmenLogTest, ReadsTheNewerLinesOfScans) {
  const CarmenLog log = read(
      "ODOM 0 0 0 0 0 0 1 h 1\nODOM 0.1 0 0 0 0 0 1 h 1\n"
      "ROBOTLASER1 0 -1.5 3.0 1.0 30 0.01 0 4 1 2 3 4 2 7 8 0.2 0 0 0.1 0 0 0 0 0 0 0 1 h 1\n");
  ASSERT_EQ(log.scans, 1u);
  int calls = 0;
  log.drive.read_scans([&](const lidar::Scan& scan) {
    ++calls;
    EXPECT_DOUBLE_EQ(scan.first_angle_rad, -1.5);
    EXPECT_DOUBLE_EQ(scan.angle_step_rad, 1);
    EXPECT_EQ(scan.ranges_m, (std::vector<float>{1, 2, 3, 4}));
  });
  EXPECT_EQ(calls, 1);
}

TEST_F(CarmenLogTest, TakesTheMaximumThatTheNewerLinesSay) {
  const CarmenLog log = read(
      "ODOM 0 0 0 0 0 0 1 h 1\nODOM 0.1 0 0 0 0 0 1 h 1\n"
      "ROBOTLASER1 0 -1.5 3.0 1.0 5 0.01 0 4 1 2 3 1e300 0 0.2 0 0 0.1 0 0 0 0 0 0 0 1 h 1\n");
  int calls = 0;
  log.drive.read_scans([&](const lidar::Scan& scan) {
    ++calls;
    EXPECT_DOUBLE_EQ(scan.range_max_m, 0.999 * 5);
    EXPECT_TRUE(std::isfinite(scan.ranges_m.back()));
  });
  EXPECT_EQ(calls, 1);
}

TEST_F(CarmenLogTest, TakesNoDirectionsBeyondATurn) {
  const std::string rest = " 30 0.01 0 2 1 2 0 0.2 0 0 0.1 0 0 0 0 0 0 0 1 h 1\n";
  std::string text = "ODOM 0 0 0 0 0 0 1 h 1\nODOM 0.1 0 0 0 0 0 1 h 1\nROBOTLASER1 0 -1.5 3.0 1.0" + rest;
  for (const char* angles : {"-1.5 3.0 0", "-1.5 3.0 7", "-1.5 3.0 -1e300", "1e300 3.0 1"})
    text += std::string("ROBOTLASER1 0 ") + angles + rest;
  const CarmenLog log = read(text);
  EXPECT_EQ(log.scans, 1u);
  EXPECT_EQ(log.damaged, 4u);
}

}  // namespace
}  // namespace astro::importing
