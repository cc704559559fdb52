#include "host/experiment/analysis/export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>

#include "host/base/error.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::experiment {
namespace {

using support::Tells;
using support::ThrowsTelling;
using testing::HasSubstr;

struct Pose {
  double x = 0, y = 0, theta = 0;

  /// The exact arc of a step, as both conventions integrate it.
  void advance(double ahead, double turn) {
    const double half = turn / 2;
    const double chord = half == 0 ? ahead : ahead * std::sin(half) / half;
    x += chord * std::cos(theta + half);
    y += chord * std::sin(theta + half);
    theta += turn;
  }
};

constexpr double kDiameter_m = 0.072, kCountsPerTurn = 2803.2;

ParameterFile calibrated() {
  ParameterFile file;
  file.parameters = {{"c_R", 1.00207703}, {"c_L", 0.99792297}, {"b", 0.28861105}};
  file.loaded = {{"c_R", 1.0}, {"c_L", 1.0}, {"b", 0.29}};
  file.wheel = NominalWheel{kDiameter_m, kCountsPerTurn};
  file.method = "ml";
  return file;
}

/// Where a wild drive of 1000 steps ends by c_R, c_L and b, as common/kinematics has them, and by the
/// formulas of diff_drive_controller (setWheelParams, updateFromPosition, integrateExact).
std::pair<Pose, Pose> driven(const ParameterFile& file, const DiffDrive& ros) {
  const auto value = [&](const char* name) { return std::get<double>(file.parameters.at(name)); };
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> counts(-300, 900);
  Pose ours, theirs;
  for (int i = 0; i < 1000; ++i) {
    const double left = counts(random), right = counts(random);
    const double travel_m = std::numbers::pi * kDiameter_m / kCountsPerTurn;
    const double l = value("c_L") * travel_m * left, r = value("c_R") * travel_m * right;
    ours.advance((r + l) / 2, (r - l) / value("b"));

    const double joint_rad = 2 * std::numbers::pi / kCountsPerTurn;
    const double left_radius = ros.left_wheel_radius_multiplier * ros.wheel_radius_m;
    const double right_radius = ros.right_wheel_radius_multiplier * ros.wheel_radius_m;
    const double separation = ros.wheel_separation_multiplier * ros.wheel_separation_m;
    const double l_ros = left * joint_rad * left_radius, r_ros = right * joint_rad * right_radius;
    theirs.advance((l_ros + r_ros) / 2, (r_ros - l_ros) / separation);
  }
  return {ours, theirs};
}

void expect_same_motion(const ParameterFile& file, const DiffDrive& ros) {
  const auto [ours, theirs] = driven(file, ros);
  ASSERT_GT(std::hypot(ours.x, ours.y), 0.1) << "a drive that went somewhere";
  // 1000 roundings of 1e-16, relative.
  EXPECT_NEAR(theirs.x, ours.x, 1e-12 * std::hypot(ours.x, ours.y));
  EXPECT_NEAR(theirs.y, ours.y, 1e-12 * std::hypot(ours.x, ours.y));
  EXPECT_NEAR(theirs.theta, ours.theta, 1e-12 * std::abs(ours.theta));
}

TEST(Export, MovesARosRobotLikeOurs) {
  const DiffDrive ros = diff_drive(calibrated(), {});
  EXPECT_EQ(ros.wheel_radius_m, kDiameter_m / 2);
  EXPECT_EQ(ros.wheel_separation_m, 0.29);
  expect_same_motion(calibrated(), ros);
}

TEST(Export, MovesItLikeOursAlsoWhenItsNominalSizesAreOthers) {
  const DiffDrive ros = diff_drive(calibrated(), {0.05, 0.3});
  EXPECT_EQ(ros.wheel_radius_m, 0.05);
  EXPECT_EQ(ros.wheel_separation_m, 0.3);
  expect_same_motion(calibrated(), ros);
}

TEST(Export, TakesAGivenRadiusForTheNominalWheelOfAFileThatTellsNone) {
  ParameterFile file = calibrated();
  file.wheel.reset();
  EXPECT_THAT([&] { diff_drive(file, {}); }, ThrowsTelling(AnalysisProblem::no_wheel_radius));
  const DiffDrive ros = diff_drive(file, {kDiameter_m / 2, std::nullopt});
  EXPECT_EQ(ros.left_wheel_radius_multiplier, 0.99792297);
  expect_same_motion(file, ros);
}

TEST(Export, NamesWhatTheFileDoesNotTell) {
  ParameterFile file = calibrated();
  file.loaded.clear();
  EXPECT_THAT([&] { diff_drive(file, {}); }, ThrowsTelling(AnalysisProblem::no_wheel_separation));
  file.parameters.erase("c_L");
  EXPECT_THAT([&] { diff_drive(file, {}); }, ThrowsTelling(AnalysisProblem::no_calibration, "c_L"));
}

TEST(Export, TakesTheNamesOfNodesThatRos2Takes) {
  for (const char* name : {"controller", "_c2", "/left_robot/controller", "a/b/c"})
    EXPECT_TRUE(is_ros2_node(name)) << name;
  for (const char* name :
       {"", "/", "my node", "2wheels", "a//b", "a/", "a/2b", "diff-drive", "a:\n  b", "räder"})
    EXPECT_FALSE(is_ros2_node(name)) << name;
  EXPECT_FALSE(is_ros2_node(std::string(256, 'a')));
}

TEST(Export, WritesNoCommentThatIsLongOrEndsEarly) {
  ParameterFile file;
  file.method = "ml\nwheels: {}";
  std::istringstream lines(ros2_yaml(file, {}, "base"));
  for (std::string line; std::getline(lines, line) && line != "base:";) {
    EXPECT_TRUE(line.starts_with("# ")) << line;
    EXPECT_LE(line.size(), 80U) << line;
  }
  file.method = "least-squares";
  EXPECT_THAT(ros2_yaml(file, {}, "base"), HasSubstr("method least-squares"));
}

TEST(Export, NamesWhatOneWheelbaseCannotSayOfARobotWithTwo) {
  ParameterFile file = calibrated();
  EXPECT_FALSE(single_wheelbase(file, diff_drive(file, {})).has_value());
  file.parameters["e"] = 0.03;
  const DiffDrive ros = diff_drive(file, {});
  EXPECT_NEAR(ros.wheel_separation_multiplier * ros.wheel_separation_m, 0.28861105, 1e-12) << "that of spins";
  const Remark note = single_wheelbase(file, ros).value();
  EXPECT_THAT(note, Tells(ExportProblem::second_wheelbase, "0.03", "3.0", "far", testing::_));
  EXPECT_NEAR(std::stod(note.values.at(3)), 1.03 * ros.wheel_separation_multiplier, 1e-5);
  std::istringstream lines(ros2_yaml(file, ros, "base"));
  std::string comments;
  for (std::string line; std::getline(lines, line) && line != "base:"; comments += line + '\n') {
    EXPECT_TRUE(line.starts_with("# ")) << line;
    EXPECT_LE(line.size(), 80U) << line;
  }
  EXPECT_THAT(comments, HasSubstr("knows one wheelbase"));
  file.parameters["e"] = -0.02;
  EXPECT_THAT(single_wheelbase(file, ros).value(),
              Tells(ExportProblem::second_wheelbase, "-0.02", "2.0", "little", testing::_));
}

TEST(Export, WritesRosNumbersAsFloatsToTheLastBit) {
  ParameterFile file = calibrated();
  file.parameters["c_R"] = 1.0;
  const DiffDrive ros = diff_drive(file, {});
  const std::string yaml = ros2_yaml(file, ros, "base");
  EXPECT_THAT(yaml, HasSubstr("base:\n  ros__parameters:\n"));
  EXPECT_THAT(yaml, HasSubstr("    right_wheel_radius_multiplier: 1.0\n")) << "an integer would be refused";
  const std::string key = "wheel_separation_multiplier: ";
  EXPECT_EQ(std::stod(yaml.substr(yaml.find(key) + key.size())), ros.wheel_separation_multiplier);
}

class ExportedFiles : public testing::Test {
 protected:
  ExportedFiles() {
    Calibration found;
    found.factors = {1.00207703, 0.99792297, 0.28861105};
    found.loaded = {1, 1, 0.29};
    found.wheel = NominalWheel{kDiameter_m, kCountsPerTurn};
    MlResult ml;
    ml.estimate.factors = found.factors;
    ml.estimate.covariance.topLeftCorner<3, 3>() << 1e-10, 2e-11, 0, 2e-11, 1e-10, 0, 0, 0, 3e-10;
    found.covariance_another_day = ml.estimate.covariance;
    found.detail = ml;
    write_calibration(file_, found);
  }
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "calib.toml";
};

TEST_F(ExportedFiles, AsTomlCanBeReadLikeTheCalibrationItself) {
  const std::filesystem::path copy = folder_.path() / "copy.toml";
  std::ofstream(copy) << toml_text(file_, diff_drive(read_parameter_file(file_), {}));
  const ParameterFile before = read_parameter_file(file_), after = read_parameter_file(copy);
  EXPECT_EQ(after.parameters, before.parameters);
  EXPECT_EQ(after.loaded, before.loaded);
  EXPECT_EQ(after.covariance, before.covariance);
  EXPECT_EQ(after.wheel, before.wheel);
  EXPECT_TRUE(after.absolute);
}

TEST_F(ExportedFiles, AsJsonHoldFactorsCovarianceAndRosParameters) {
  const nlohmann::json json =
      nlohmann::json::parse(json_text(file_, diff_drive(read_parameter_file(file_), {})));
  EXPECT_EQ(json["parameters"]["b"], 0.28861105);
  EXPECT_EQ(json["covariance"]["matrix"][0][1], 2e-11);
  EXPECT_TRUE(json["standard_errors"]["c_R"].is_null()) << "not known here, and JSON has no NaN";
  EXPECT_EQ(json["diff_drive_controller"]["wheel_separation"], 0.29);
}

}  // namespace
}  // namespace astro::experiment
