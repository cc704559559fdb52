#include "host/import/drives/robot_geometry.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "host/import/drives/wheel_run.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::importing {
namespace {

using support::Tells;
using support::told_by;
using testing::Optional;

class RobotFile : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
    return folder_.path() / name;
  }
  test::TemporaryFolder folder_;
};

TEST_F(RobotFile, OfExportedParametersHasTheirSizesAndFactors) {
  const RobotGeometry robot = read_robot_file(file(
      "astro.toml",
      "# a robot\n[parameters]\nwheel_diameter = 0.072\ncounts_per_motor_rev = 64\ngear_numerator = 219\n"
      "gear_denominator = 5\nb = 0.29\nc_R = 1.002\nc_L = 0.999\n"));
  EXPECT_THAT(robot.wheel_diameter_m, Optional(0.072));
  EXPECT_THAT(robot.counts_per_turn, Optional(64.0 * 219 / 5));
  EXPECT_THAT(robot.wheelbase_m, Optional(0.29));
  EXPECT_EQ(robot.c_r, 1.002);
  EXPECT_EQ(robot.c_l, 0.999);
}

TEST_F(RobotFile, MayHaveACurvatureEffect) {
  const auto robot = [&](const std::string& more) {
    return read_robot_file(file("astro.toml", "[parameters]\nwheel_diameter = 0.072\nb = 0.29\n" + more))
        .factors();
  };
  EXPECT_EQ(robot("e = -0.02\nkappa0 = 0.3\n").e, -0.02);
  EXPECT_EQ(robot("e = -0.02\nkappa0 = 0.3\n").kappa0, 0.3);
  EXPECT_EQ(robot("").e, 0);
  EXPECT_EQ(robot("").kappa0, calibration::kUsualKappa0);
  EXPECT_THROW(robot("e = 3\n"), Error);
}

TEST_F(RobotFile, MayBeACalibrationThatTheRobotCarries) {
  const RobotGeometry robot =
      read_robot_file(file("calib.toml",
                           "[parameters]\nc_R = 1.002\nc_L = 0.999\nb = 0.2014\n"
                           "[nominal]\nwheel_diameter = 0.084\ncounts_per_wheel_turn = 2796.8\n"));
  EXPECT_THAT(robot.wheel_diameter_m, Optional(0.084));
  EXPECT_THAT(robot.counts_per_turn, Optional(2796.8));
  EXPECT_THAT(robot.wheelbase_m, Optional(0.2014));
}

TEST_F(RobotFile, OfAControllerMayBeginAsADocumentOfYaml) {
  const std::string body = "diff_drive_controller:\n  ros__parameters:\n    wheel_separation: 0.16\n";
  for (const char* head : {"---\n", "# a robot\n\n--- # its base\n", "%YAML 1.2\n---\n"})
    EXPECT_THAT(read_robot_file(file("c.yaml", head + body)).wheelbase_m, Optional(0.16)) << head;
}

/// A second of wheels, worked out from the poses of the topic `odometry` if one is named.
WheelRun a_second_of_wheels(const RobotGeometry& robot, const std::string& odometry) {
  ImportedWheels wheels;
  wheels.track.unit = WheelUnit::radians;
  wheels.track.odometry = odometry;
  for (int i = 0; i <= 50; ++i) wheels.track.samples.push_back({20'000'000 * i, 0.1 * i, 0.1 * i});
  return run_of_wheels("drive.db3", wheels, robot);
}

TEST_F(RobotFile, WhoseOdometryIsMadeOfCommandsSaysNothingOfTheWheels) {
  const std::string yaml =
      "diff_drive_controller:\n  ros__parameters:\n    wheel_separation: 0.16\n    wheel_radius: 0.033\n";
  const RobotGeometry open = read_robot_file(file("open.yaml", yaml + "    open_loop: true\n")),
                      closed = read_robot_file(file("closed.yaml", yaml));
  EXPECT_THAT(told_by([&] { a_second_of_wheels(open, "/odom"); }),
              Tells(ImportProblem::odometry_of_commands, "/odom"));
  EXPECT_EQ(a_second_of_wheels(closed, "/odom").run.odometry.size(), 51U);
  EXPECT_EQ(a_second_of_wheels(open, "").run.odometry.size(), 51U) << "states of the joints are measured";
}

TEST_F(RobotFile, OfADiffDriveControllerHasItsMultipliersAsWhatTheRobotCarried) {
  const RobotGeometry robot = read_robot_file(
      file("controllers.yaml",
           "diff_drive_controller:\n  ros__parameters:\n    left_wheel_names: [\"left_joint\"]\n"
           "    right_wheel_names: [\"right_joint\"]\n    wheel_separation: 0.16\n    wheel_radius: 0.033\n"
           "    wheel_separation_multiplier: 1.05\n    left_wheel_radius_multiplier: 0.99\n"
           "    right_wheel_radius_multiplier: 1.01\n"));
  EXPECT_THAT(robot.wheel_diameter_m, Optional(0.066));
  EXPECT_EQ(robot.counts_per_turn, std::nullopt);
  EXPECT_THAT(robot.wheelbase_m, Optional(testing::DoubleEq(0.16 * 1.05)));
  EXPECT_EQ(robot.c_r, 1.01);
  EXPECT_EQ(robot.c_l, 0.99);
  EXPECT_EQ(robot.joints, (JointPair{"left_joint", "right_joint"}));
}

TEST_F(RobotFile, WithTwoControllersAsksForOne) {
  const auto path = file("two.yaml",
                         "a:\n  ros__parameters:\n    wheel_radius: 0.03\n    wheel_separation: 0.2\n"
                         "b:\n  ros__parameters:\n    wheel_radius: 0.04\n    wheel_separation: 0.3\n");
  EXPECT_THAT(told_by([&] { read_robot_file(path); }), Tells(WheelProblem::controller_unclear, "a", "b"));
  EXPECT_THAT(read_robot_file(path, "b").wheelbase_m, Optional(0.3));
}

TEST_F(RobotFile, OptionsCountMoreThanTheFile) {
  RobotGeometry file, given;
  file.wheel_diameter_m = 0.1;
  file.wheelbase_m = 0.3;
  file.c_r = 1.01;
  given.wheelbase_m = 0.31;
  const RobotGeometry both = file.overridden_by(given);
  EXPECT_THAT(both.wheelbase_m, Optional(0.31));
  EXPECT_THAT(both.wheel_diameter_m, Optional(0.1));
  EXPECT_EQ(both.c_r, 1.01);
}

TEST_F(RobotFile, WithASizeThatNoRobotHasIsNamed) {
  const auto path = file("bad.toml", "[parameters]\nwheel_diameter = -0.072\nb = 0.29\n");
  EXPECT_THAT(told_by([&] { read_robot_file(path); }),
              Tells(ImportProblem::size_not_above_zero, path.string(), "wheel_diameter"));
}

}  // namespace
}  // namespace astro::importing
