#include "host/import/scans/bag_scans.hpp"

#include <gtest/gtest.h>

#include "host/import/scans/carmen_log.hpp"
#include "host/import/scans/scanned_drives.hpp"
#include "host/lidar/scan_calibration.hpp"
#include "tests/host/import/scans/scan_bag.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::importing {
namespace {

constexpr std::int64_t kStart_ns = 1'790'000'000'000'000'000;  // more digits than a double has

lidar::SyntheticDrive turtle_drive(int rounds) {
  lidar::Scanner scanner;
  scanner.place = {-0.03, 0, 0};
  scanner.spins = true;
  lidar::SyntheticDrive drive(lidar::furnished_room(), {{1.013, 1.007, 0.306}, 2e-6}, scanner, 31);
  lidar::drive_both_ways(drive, rounds);
  return drive;
}

class BagScansTest : public testing::Test {
 protected:
  std::filesystem::path bag(int rounds, const std::vector<std::string>& topics) {
    const std::filesystem::path path = folder_.path() / "drive.mcap";
    write_scan_bag(path, turtle_drive(rounds), topics, kStart_ns);
    return path;
  }
  test::TemporaryFolder folder_;
};

TEST_F(BagScansTest, AreThoseThatWereRecordedInOrder) {
  const lidar::SyntheticDrive drive = turtle_drive(1);
  std::vector<lidar::Scan> recorded, read;
  drive.recorded().read_scans([&](const lidar::Scan& scan) { recorded.push_back(scan); });
  const BagScans scans = scans_in_bag(bag(1, {"/scan"}));
  EXPECT_EQ(scans.topic, "/scan");
  for (int again = 0; again < 2; ++again) {
    read.clear();
    scans.read([&](const lidar::Scan& scan) { read.push_back(scan); });
    ASSERT_EQ(read.size(), recorded.size());
  }
  EXPECT_EQ(read[7].time_ns, kStart_ns + recorded[7].time_ns);
  EXPECT_FLOAT_EQ(static_cast<float>(read[7].beam_interval_s),
                  static_cast<float>(recorded[7].beam_interval_s));
  EXPECT_EQ(read[7].ranges_m.size(), recorded[7].ranges_m.size());
  EXPECT_EQ(read[7].ranges_m[11], recorded[7].ranges_m[11]);
}

TEST_F(BagScansTest, CalibrateTheWheelsInTheSameBag) {
  const std::filesystem::path path = bag(3, {"/scan"});
  EXPECT_TRUE(has_scans_alone(path));
  ImportChoices choices;
  choices.geometry.wheel_diameter_m = kWheelDiameter_m;
  choices.geometry.wheelbase_m = lidar::kNominalBase_m;
  const DriveFiles files{path, path};
  const ScannedDrives drives = scanned_drives({&files, 1}, choices);
  ASSERT_TRUE(drives.wheel);
  EXPECT_EQ(drives.wheel->diameter_m, kWheelDiameter_m);
  const lidar::ScanCalibration found = lidar::calibrate_by_scans(drives.drives, drives.loaded);
  EXPECT_TRUE(found.choice.better());
  EXPECT_NEAR(found.factors.c_r / found.factors.c_l, 1.013 / 1.007, 1e-3);
  EXPECT_NEAR(found.factors.b_m, 0.306, 0.001);
  EXPECT_NEAR(found.scanner.x_m, -0.03, 0.006);
  EXPECT_NEAR(found.late_s, 0, 0.005);
}

TEST_F(BagScansTest, OnSeveralTopicsHaveToBeNamed) {
  const std::filesystem::path path = bag(1, {"/front", "/rear"});
  for (const char* topic : {"", "/scan"}) try {
      scans_in_bag(path, topic);
      ADD_FAILURE() << topic;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Kind(ScanFileProblem::topic_unclear));
      EXPECT_EQ(error.values(), (std::vector<std::string>{"/front", "/rear"}));
    }
  EXPECT_EQ(scans_in_bag(path, "/rear").topic, "/rear");
}

TEST_F(BagScansTest, ThatAreNotThereAreMissed) {
  const std::filesystem::path path = bag(1, {});
  EXPECT_FALSE(has_scans_alone(path));
  try {
    scans_in_bag(path);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Kind(ScanFileProblem::no_scans));
  }
}

/// A scan that can be read.
ros2::msg::LaserScan plain_scan() {
  ros2::msg::LaserScan scan;
  scan.angle_min = -1;
  scan.angle_increment = 1;
  scan.range_max = 10;
  scan.ranges = {1, 2, 3};
  return scan;
}

class OddScans : public BagScansTest {
 protected:
  std::filesystem::path bag_of(const std::vector<ros2::msg::LaserScan>& scans) {
    const std::filesystem::path path = folder_.path() / "odd.mcap";
    write_scans(path, scans);
    return path;
  }
  static std::size_t read_from(const BagScans& scans) {
    std::size_t read = 0;
    scans.read([&](const lidar::Scan&) { ++read; });
    return read;
  }
};

TEST_F(OddScans, AreLeftOutAndCounted) {
  std::vector<ros2::msg::LaserScan> scans(5, plain_scan());
  scans[1].ranges.resize(100'001, 1);
  scans[2].angle_increment = 7;
  scans[3].angle_min = -1e30F;
  const BagScans found = scans_in_bag(bag_of(scans));
  EXPECT_EQ(read_from(found), 2u);
  ASSERT_FALSE(found.remarks.empty());
  EXPECT_EQ(found.remarks.front().sentence, "scans of /scan: 3 cannot be read and were left out");
}

TEST_F(OddScans, AloneAreRefusedWithTheirNumber) {
  ros2::msg::LaserScan odd = plain_scan();
  odd.angle_increment = 0;
  const std::filesystem::path path = bag_of({odd, odd});
  try {
    scans_in_bag(path);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Kind(ScanFileProblem::all_unreadable));
    EXPECT_EQ(error.values(), (std::vector<std::string>{path.string(), "/scan", "2"}));
  }
}

}  // namespace
}  // namespace astro::importing
