#include "host/wall/wall_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/robots/wall_desk.hpp"

namespace astro::wall {
namespace {

TEST(WallCalibration, IsTheSameAfterItWasWrittenAndRead) {
  const support::TemporaryFolder folder;
  support::WallDesk desk(support::robot_before_a_wall(21));
  WallPlan plan;
  plan.targets = {2e-3, 5e-3};
  plan.line_m = 2;
  const WallResult result = run_wall_experiment(desk.desk.client, plan, folder.path(), desk.hooks());
  const auto judgement = judge_wall(result.journal.drive, result.estimate, result.journal.loaded);
  const experiment::ParameterFile written = parameter_file_of(result, judgement);
  experiment::write_parameter_file(folder.path() / "calib.toml", written);
  const experiment::ParameterFile read = experiment::read_parameter_file(folder.path() / "calib.toml");
  EXPECT_EQ(read.parameters, written.parameters);
  EXPECT_EQ(read.loaded, written.loaded);
  for (const char* name : {"c_R", "c_L", "b"})
    EXPECT_EQ(read.standard_errors.at(name), written.standard_errors.at(name));
  EXPECT_TRUE(std::isnan(read.standard_errors.at("e")));
  EXPECT_EQ(read.covariance, written.covariance);
  EXPECT_EQ(read.slip_K_m, written.slip_K_m);
  EXPECT_EQ(read.wheel->diameter_m, 0.072);
  EXPECT_NEAR(read.wheel->counts_per_turn, 2803.2, 1e-9);
  EXPECT_EQ(read.robot, written.robot);
  EXPECT_EQ(read.method, "wall");
  EXPECT_TRUE(read.absolute);
  EXPECT_EQ(read.verdict, written.verdict);
  EXPECT_EQ(read.verdict_sentence, judgement.sentence());

  const nlohmann::json json = to_json(result, judgement);
  EXPECT_EQ(json.at("b_m").get<double>(), result.estimate.factors.b_m);
  EXPECT_EQ(json.at("readings").get<int>(), 2);
}

TEST(WallCalibration, IsNotAbsoluteWithoutARuler) {
  const support::TemporaryFolder folder;
  support::WallDesk desk(support::robot_before_a_wall(22));
  WallPlan plan;
  plan.targets = {2e-3, 5e-3};
  plan.readings = 0;
  const WallResult result = run_wall_experiment(desk.desk.client, plan, folder.path(), desk.hooks());
  const auto judgement = judge_wall(result.journal.drive, result.estimate, result.journal.loaded);
  EXPECT_FALSE(parameter_file_of(result, judgement).absolute);
  EXPECT_TRUE(to_json(result, judgement).at("scale").is_null());
  EXPECT_TRUE(to_json(result, judgement).at("se").at("scale").is_null());
}

}  // namespace
}  // namespace astro::wall
