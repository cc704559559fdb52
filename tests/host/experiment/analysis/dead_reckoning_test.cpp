#include "host/experiment/analysis/dead_reckoning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/experiment/drive/experiment.hpp"
#include "host/experiment/files/curvature_named.hpp"
#include "host/experiment/files/experiment_folder.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/desk.hpp"

namespace astro::experiment {
namespace {

using support::Desk;
using support::TemporaryFolder;
using support::ThrowsTelling;

/// Two squares of a simulated robot without slip, before and after its calibration.
class DeadReckonings : public testing::Test {
 protected:
  DeadReckonings() : desk_(support::thesis_robot(0, 1)) {
    Plan plan;
    plan.runs = 1;
    plan.side_m = 1.5;
    plan.extras = false;
    plan.truth = "sim";
    run_experiment(desk_.client, desk_.truth, plan, folder_.path(), {});
  }
  RunSet phase(const char* name) const { return read_run_set(folder_.path() / name); }

  TemporaryFolder folder_;
  Desk desk_;
};

TEST_F(DeadReckonings, OfDrivesNotSeenAreBetterByTheCalibration) {
  const RunSet unseen = phase("after");
  const NominalWheel wheel = nominal_wheel(unseen.runs.front().info, unseen.names.front());
  const NamedFactors before{"before", loaded_factors(phase("before").runs.front().info)};
  const NamedFactors found = factors_of_file(folder_.path() / "calib-before.toml", wheel);
  const auto judged = dead_reckon(unseen, std::vector{before, found});
  ASSERT_EQ(judged.size(), 2U);
  EXPECT_EQ(judged[0].by.name, "before");
  EXPECT_EQ(judged[1].errors.runs.front().name, "square-ccw-1");
  // A 1.5 m square of this robot ends 12 cm beside; without slip a millimetre stays of resolution and noise.
  EXPECT_GT(judged[0].errors.final_rms_m, 0.05);
  EXPECT_LT(judged[1].errors.final_rms_m, 0.002);
  EXPECT_LT(judged[1].errors.path_rms_m, 0.002);
}

TEST_F(DeadReckonings, ByTheFactorsOfAnotherWheelAreRefused) {
  const RunSet unseen = phase("after");
  NominalWheel other = nominal_wheel(unseen.runs.front().info, unseen.names.front());
  other.diameter_m *= 1.01;
  const std::filesystem::path path = folder_.path() / "calib-before.toml";
  EXPECT_THAT([&] { factors_of_file(path, other); },
              ThrowsTelling(AnalysisProblem::factors_of_other_wheel, path.string()));
}

TEST_F(DeadReckonings, TakeEFromTheFileAndNoneWhereItHasNone) {
  const auto path = folder_.path() / "other.toml";
  const auto factors = [&](const ParameterValues& more) {
    ParameterValues values{{"c_R", 1.0}, {"c_L", 1.0}, {"b", 0.29}};
    values.insert(more.begin(), more.end());
    write_parameters(path, values);
    return factors_of_file(path, {}).factors;
  };
  EXPECT_EQ(factors({}).e, 0);
  EXPECT_EQ(factors({}).kappa0, calibration::kUsualKappa0);
  EXPECT_EQ(factors({{"e", -0.02}, {"kappa0", 0.5}}).e, -0.02);
  EXPECT_EQ(factors({{"e", -0.02}, {"kappa0", 0.5}}).kappa0, 0.5);
  const std::string name = path.string();
  EXPECT_THAT([&] { factors({{"e", 3.0}}); }, ThrowsTelling(CurvatureProblem::of_no_robot, name, "e", "3"));
  EXPECT_THAT(
      [&] {
        factors({{"e", std::string("0.02")}});
      },
      ThrowsTelling(CurvatureProblem::is_text, name, "e", "0.02"));
  EXPECT_THAT(
      [&] {
        factors({{"kappa0", 0.0}});
      },
      ThrowsTelling(CurvatureProblem::of_no_robot, name, "kappa0", "0"));
}

TEST_F(DeadReckonings, ByAFileWithoutFactorsAreRefused) {
  const auto path = folder_.path() / "other.toml";
  write_parameters(path, {{"c_R", 1.0}, {"b", 0.29}});
  EXPECT_THAT([&] { factors_of_file(path, {}); },
              ThrowsTelling(AnalysisProblem::no_calibration, "c_L", path.string()));
}

}  // namespace
}  // namespace astro::experiment
