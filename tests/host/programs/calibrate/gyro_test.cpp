#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/bags/turtlebot_bag.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/programs/program.hpp"

// Bags of a robot with a gyro: `calibrate bag` calibrates it beside the wheels, `calibrate gyro` the wheels by it.
namespace astro {
namespace {

using support::astrolabe;
using support::Outcome;

support::BagDrive drive_with_errors() {
  support::BagDrive drive;
  drive.robot.true_ed = 1.00416;
  drive.robot.true_wheelbase_m = 0.99521 * drive.robot.nominal_wheelbase_m;
  drive.gyro = {.scale = 0.01, .bias_radps = 0.004};
  drive.room = simulation::rectangular_room({-2, -3.5}, {4.5, 4});
  drive.room.walls.push_back({{-2, 1.5}, {-1.2, 1.5}});  // so that no half of the room looks like the other
  drive.room.walls.push_back({{-1.2, 1.5}, {-1.2, 4}});
  drive.path = support::calibration_drive(1.8, 2);
  return drive;
}

TEST(BagWithGyro, CalibratesTheGyroBesideTheWheelsAndTheWheelsByTheGyro) {
  const test::TemporaryFolder folder;
  const support::BagDrive drive = drive_with_errors();
  const std::string bag = (folder.path() / "drive.mcap").string();
  support::record_bag(drive, bag);
  const auto by = [&](const std::string& method, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"calibrate", method,        bag,   "--wheel-diameter",
                                   "0.072",     "--wheelbase", "0.29"};
    words.insert(words.end(), more.begin(), more.end());
    return astrolabe(words);
  };
  const Outcome by_scans = by("bag", {"--json"});
  ASSERT_EQ(by_scans.code, 0) << by_scans.err;
  const nlohmann::json gyro = support::parse_json(by_scans.out)["gyro"];
  const double scale_se = gyro["scale_se"].get<double>();
  EXPECT_NEAR(gyro["scale"].get<double>(), 1 + drive.gyro.scale, 4 * scale_se);
  EXPECT_LT(scale_se, 2e-3) << "a third of a degree in a turn";
  EXPECT_EQ(gyro["sign"], 1);
  EXPECT_EQ(gyro["slips"].size(), 0U);

  const Outcome alone = by("gyro", {"--json"});
  ASSERT_EQ(alone.code, 0) << alone.err;
  const nlohmann::json found = support::parse_json(alone.out);
  EXPECT_NEAR(found["E_d"].get<double>(), drive.robot.true_ed, 4 * found["E_d_se"].get<double>());
  EXPECT_LT(found["E_d_se"].get<double>(), 1e-3);
  EXPECT_NEAR(found["b"].get<double>(), drive.robot.true_wheelbase_m, 3 * found["b_se"].get<double>());
  EXPECT_NE(by("gyro").out.find("the gyro's scale is right to 1 %"), std::string::npos);
  const Outcome other = by("gyro", {"--imu-topic", "/other"});
  EXPECT_EQ(other.code, 1);
  EXPECT_NE(other.err.find("/other"), std::string::npos) << other.err;
}

TEST(BagWithGyro, IsNeededForACalibrationByTheGyro) {
  const test::TemporaryFolder folder;
  support::BagDrive drive = drive_with_errors();
  drive.gyro.rate_hz = 0;
  const std::string bag = (folder.path() / "drive.mcap").string();
  support::record_bag(drive, bag);
  const Outcome outcome =
      astrolabe({"calibrate", "gyro", bag, "--wheel-diameter", "0.072", "--wheelbase", "0.29"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("--imu-topic names the IMU"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace astro
