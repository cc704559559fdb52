#include "host/experiment/analysis/calibration_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <optional>

#include "host/base/file_problem.hpp"
#include "host/base/text/numbers.hpp"
#include "host/experiment/analysis/parameter_file_problem.hpp"
#include "host/experiment/drive/change_guard.hpp"
#include "host/experiment/files/toml_file.hpp"
#include "host/robot/parameters/parameter_problem.hpp"
#include "host/robot/parameters/upload.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/desk.hpp"

namespace astro::experiment {
namespace {

using support::Tells;
using support::ThrowsTelling;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;

class CalibrationFile : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) const {
    const std::filesystem::path path = folder_.path() / "calib.toml";
    std::ofstream(path) << text;
    return path;
  }
  support::TemporaryFolder folder_;
};

Calibration example() {
  Calibration found;
  found.factors = {1.0020770312345678, 0.9979229687654322, 0.2886110512345678};
  found.loaded = {1, 1, 0.29};
  return found;
}

TEST_F(CalibrationFile, KeepsAnEstimateFromEndPosesToTheLastBit) {
  const Calibration found = example();  // with unknown standard errors
  const std::filesystem::path path = folder_.path() / "calib.toml";
  write_calibration(path, found);
  const ParameterFile read = read_parameter_file(path);
  EXPECT_EQ(std::get<double>(read.parameters.at("c_R")), found.factors.c_r);
  EXPECT_EQ(std::get<double>(read.parameters.at("c_L")), found.factors.c_l);
  EXPECT_EQ(std::get<double>(read.parameters.at("b")), found.factors.b_m);
  EXPECT_EQ(read.loaded.at("b"), 0.29);
  EXPECT_FALSE(read.absolute);
  EXPECT_FALSE(read.wheel.has_value());
  EXPECT_FALSE(read.covariance.has_value());
  EXPECT_FALSE(read.slip_K_m.has_value());
}

// b cut from 0.2886 to 0.28 is a number, and the verdict and the robot's identity stand at the end.
TEST_F(CalibrationFile, ThatIsCutOffAnywhereIsRefused) {
  const std::filesystem::path whole = folder_.path() / "whole.toml";
  write_calibration(whole, example());
  std::ifstream in(whole);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  ASSERT_NO_THROW(read_parameter_file(file(text)));
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_THROW(read_parameter_file(file(text.substr(0, size))), Error) << "after " << size << " bytes";
  const std::size_t in_b = text.find("0.2886") + 4;
  EXPECT_THAT([&] { read_parameter_file(file(text.substr(0, in_b))); },
              ThrowsTelling(TomlProblem::cut_off, (folder_.path() / "calib.toml").string()));
  EXPECT_NO_THROW(read_parameter_file(file(text + "\n[notes]\nby = \"me\"\n")));
}

TEST_F(CalibrationFile, KeepsCovarianceAndNominalWheelOfMaximumLikelihood) {
  Calibration found = example();
  MlResult ml;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) ml.estimate.covariance(i, j) = 1e-9 / (1 + i + j);
  found.covariance_another_day = 2 * ml.estimate.covariance;
  found.detail = ml;
  found.wheel = NominalWheel{0.072, 2803.2};
  const std::filesystem::path path = folder_.path() / "calib.toml";
  write_calibration(path, found);
  const ParameterFile read = read_parameter_file(path);
  EXPECT_EQ(read.covariance, found.covariance_another_day);
  EXPECT_EQ(read.slip_K_m, ml.estimate.noise.K_m);
  EXPECT_EQ(read.wheel, found.wheel);
  EXPECT_TRUE(read.absolute);
  EXPECT_EQ(read.method, "ml");
}

TEST_F(CalibrationFile, KeepsEAndWhatWasLoadedAndItsError) {
  Calibration found = example();
  found.factors.e = 0.0312345678;
  found.factors.kappa0 = 0.2;
  found.loaded.e = -0.01;
  found.se_another_day.e = 0.002;
  const std::filesystem::path path = folder_.path() / "calib.toml";
  write_calibration(path, found);
  const ParameterFile read = read_parameter_file(path);
  EXPECT_EQ(std::get<double>(read.parameters.at("e")), found.factors.e);
  EXPECT_EQ(std::get<double>(read.parameters.at("kappa0")), 0.2);
  EXPECT_EQ(read.loaded.at("e"), -0.01);
  EXPECT_EQ(read.standard_errors.at("e"), 0.002);
}

// A tape measure gives standard errors of c_R, c_L and b alone.
TEST_F(CalibrationFile, WithoutACovarianceIsAsUncertainAsItsStandardErrorsAndANominalScale) {
  ParameterFile tape;
  tape.parameters = {{"c_R", 1.002}, {"c_L", 0.998}, {"b", 0.29}};
  EXPECT_FALSE(covariance_in(tape).has_value());
  tape.standard_errors = {{"c_R", 3e-4}, {"c_L", 3e-4}, {"b", 2.9e-4}, {"e", FactorErrors::kUnknown}};
  const auto covariance = covariance_in(tape);
  ASSERT_TRUE(covariance.has_value());
  const calibration::MlErrors se = calibration::errors_of(*covariance, {1.002, 0.998, 0.29});
  EXPECT_NEAR(se.E_d, 6e-4, 1e-5);  // one wheel is too large by as much as the other is too small
  EXPECT_NEAR(se.b_over_scale_m, 2.9e-4, 1e-5);
  EXPECT_NEAR(se.scale, kErrorOfNominalScale, 1e-5);
  EXPECT_EQ(se.e, calibration::PriorOfE::kStandardDeviation);
}

TEST_F(CalibrationFile, WritesAnEOfZeroSoThatItResetsTheRobots) {
  const std::filesystem::path path = folder_.path() / "calib.toml";
  write_calibration(path, example());
  EXPECT_EQ(std::get<double>(read_parameter_file(path).parameters.at("e")), 0);
}

TEST_F(CalibrationFile, OfAVersionWithoutEHasACovarianceOfThree) {
  const auto path = file(
      "[parameters]\nc_R = 1.0\n[covariance]\nmatrix = [[1.0, 2.0, 3.0], [2.0, 5.0, 6.0], "
      "[3.0, 6.0, 9.0]]\n");
  const auto covariance = read_parameter_file(path).covariance.value();
  EXPECT_EQ(covariance(2, 1), 6);
  EXPECT_EQ(covariance(3, 3), 0);
}

TEST_F(CalibrationFile, SaysWhatIsDamaged) {
  const auto refuses = [&](const std::string& more, ParameterFileProblem problem) {
    const auto path = file("[parameters]\nc_R = 1.0\n" + more);
    EXPECT_THAT([&] { read_parameter_file(path); }, ThrowsTelling(problem, path.string())) << more;
  };
  refuses("[slip]\nK = -1e-6\n", ParameterFileProblem::bad_slip);
  refuses("[slip]\n", ParameterFileProblem::bad_slip);
  refuses("[slip]\nK = nan\n", ParameterFileProblem::bad_slip);
  refuses("[covariance]\nmatrix = [[1.0, 2.0], [3.0, 4.0]]\n", ParameterFileProblem::bad_covariance);
  refuses("[nominal]\nwheel_diameter = 0.0\ncounts_per_wheel_turn = 1.0\n", ParameterFileProblem::bad_wheel);
}

TEST_F(CalibrationFile, KeepsTextAndNumbersOfAnExport) {
  const ParameterValues values{{"robot_name", std::string("R2 \"D2\"")}, {"kp", 40.0}};
  const std::filesystem::path path = folder_.path() / "robot.toml";
  write_parameters(path, values);
  EXPECT_EQ(read_parameter_file(path).parameters, values);
  std::ifstream file(path);
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(file), {}), HasSubstr("only tried"));
}

TEST_F(CalibrationFile, NamesTheFileThatIsNotThere) {
  EXPECT_THAT([] { read_parameter_file("/nowhere/calib.toml"); },
              ThrowsTelling(FileProblem::missing, "/nowhere/calib.toml"));
}

TEST_F(CalibrationFile, NamesFileAndLineOfWhatIsNotToml) {
  const auto path = file("[parameters]\nc_R = = 1\n");
  EXPECT_THAT([&] { read_parameter_file(path); }, ThrowsTelling(TomlProblem::not_toml, path.string(), "2"));
}

TEST_F(CalibrationFile, SaysThatAFileHasNoParameters) {
  for (const char* text : {"", "a = 1\n", "[parameters]\n", "parameters = 1\n"}) {
    const auto path = file(text);
    EXPECT_THAT([&] { read_parameter_file(path); },
                ThrowsTelling(ParameterFileProblem::no_parameters, path.string()))
        << text;
  }
}

TEST_F(CalibrationFile, NamesTheValueThatIsNeitherNumberNorText) {
  const auto path = file("[parameters]\nc_R = [1, 2]\n");
  EXPECT_THAT([&] { read_parameter_file(path); },
              ThrowsTelling(ParameterFileProblem::value_of_other_type, path.string(), "c_R"));
}

TEST_F(CalibrationFile, KeepsTheRobotWhateverItsName) {
  Calibration found = example();
  const std::filesystem::path path = folder_.path() / "calib.toml";
  write_calibration(path, found);
  EXPECT_EQ(read_parameter_file(path).robot, RobotIdentity{});
  found.robot = {"\"Räder\" \\ 2", "00ff"};
  write_calibration(path, found);
  EXPECT_EQ(read_parameter_file(path).robot, found.robot);
}

TEST(RobotIdentity, IsToldApartByTheIdAlone) {
  const RobotIdentity one{"ASTRO", "01"}, other{"ASTRO", "02"}, renamed{"ARES", "01"};
  EXPECT_EQ(different_robots("the file", one, "this", other),
            "the file is of robot ASTRO (01), and this is ASTRO (02)");
  EXPECT_EQ(different_robots("the file", one, "this", renamed), "");
  EXPECT_EQ(different_robots("the file", {}, "this", one), "") << "nobody knows";
}

class ChangeGuard : public testing::Test {
 protected:
  ChangeGuard() : desk_(sim::Config{}), robot_(robot::RemoteParameters::fetch(desk_.client)) {}
  support::Desk desk_;
  robot::RemoteParameters robot_;
};

TEST_F(ChangeGuard, LeavesOutWhatTheRobotHoldsAlready) {
  const auto list = changes(robot_, {{"c_R", 1.0}, {"c_L", 0.999}});
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].name, "c_L");
  EXPECT_EQ(std::get<double>(list[0].before), 1.0);
}

TEST_F(ChangeGuard, DoubtsWheelFactorsThatMoveByMoreThanATenth) {
  EXPECT_THAT(suspicion(changes(robot_, {{"b", 0.32}})),
              Optional(Tells(UploadProblem::suspicious, "b", "+10.3")));
  EXPECT_EQ(suspicion(changes(robot_, {{"b", 0.31}})), std::nullopt);
  EXPECT_EQ(suspicion(changes(robot_, {{"kp", 80.0}})), std::nullopt) << "a gain may change as it likes";
}

TEST_F(ChangeGuard, LetsEComeAndGoAndChangeItsSign) {
  const auto change = [](double before, double after) {
    return std::vector<Change>{{"e", "", before, after}};
  };
  for (const auto& [before, after] : {std::pair{0.0, 0.03}, {0.03, 0.0}, {0.03, -0.03}, {0.0, 0.1}}) {
    EXPECT_EQ(suspicion(change(before, after)), std::nullopt) << before << ' ' << after;
    EXPECT_THAT(far_changes(robot_, change(before, after)), IsEmpty()) << before << ' ' << after;
  }
  for (const auto& [before, after] : {std::pair{0.0, 0.11}, {0.06, -0.06}}) {
    EXPECT_THAT(suspicion(change(before, after)),
                Optional(Tells(UploadProblem::suspicious, "e", to_text(before), to_text(after))));
    EXPECT_THAT(far_changes(robot_, change(before, after)), ElementsAre(HasSubstr("e would go from ")));
  }
  EXPECT_EQ(suspicion({{"kappa0", "", 0.6, 0.12}}), std::nullopt)
      << "which of these it is drives do not show";
  EXPECT_THAT(far_changes(robot_, {{"kappa0", "", 0.6, 0.12}}), IsEmpty());
}

TEST_F(ChangeGuard, AFirmwareThatKnowsNoETakesAnEOfZeroAndNoOther) {
  std::vector<robot::ParameterRow> rows = robot_.rows();
  std::erase_if(rows, [](const auto& row) { return row.name == "e" || row.name == "kappa0"; });
  EXPECT_EQ(understood_by(rows, {{"c_R", 1.001}, {"e", 0.0}, {"kappa0", 0.12}}),
            (ParameterValues{{"c_R", 1.001}}));
  EXPECT_THAT(
      [&] {
        understood_by(rows, {{"c_R", 1.001}, {"e", 0.03}});
      },
      ThrowsTelling(UploadProblem::e_unknown_to_firmware, "0.03"));
  const ParameterValues all{{"c_R", 1.001}, {"e", 0.03}};
  EXPECT_EQ(understood_by(robot_.rows(), all), all);
}

TEST_F(ChangeGuard, FactorsThatKnowNoEAreNotForARobotThatHasOne) {
  robot::upload(desk_.client, {{"e", 0.03}});
  robot_.refresh();
  ParameterFile file;
  file.method = "ml";
  file.absolute = true;
  file.parameters = {{"c_R", 1.001}, {"c_L", 0.999}, {"b", 0.29}};
  EXPECT_THAT(objections(robot_, {}, file, {}), ElementsAre(Tells(UploadProblem::foreign_e, "0.03")));
  file.parameters["e"] = 0.0;
  EXPECT_THAT(objections(robot_, {}, file, {}), IsEmpty());
  file.absolute = false;
  file.loaded = {{"c_R", 1.0}, {"c_L", 1.0}, {"b", 0.29}, {"e", 0.02}};
  EXPECT_THAT(wrong_loaded_factors(robot_, file),
              Optional(Tells(UploadProblem::of_other_factors, "e", "0.02", testing::StartsWith("0.03"))));
  file.loaded["e"] = 0.03;
  EXPECT_EQ(wrong_loaded_factors(robot_, file), std::nullopt);
}

TEST_F(ChangeGuard, FactorsFromEndPosesNeedWhatWasCarriedAndAbsoluteOnesDoNot) {
  ParameterFile file;
  file.loaded = {{"c_R", 1.001}};
  EXPECT_THAT(wrong_loaded_factors(robot_, file),
              Optional(Tells(UploadProblem::of_other_factors, "c_R", "1.001", "1")));
  file.loaded = {{"c_R", 1.0}};
  EXPECT_EQ(wrong_loaded_factors(robot_, file), std::nullopt);
  file.loaded = {{"c_R", 1.001}};
  file.absolute = true;
  EXPECT_EQ(wrong_loaded_factors(robot_, file), std::nullopt);
}

TEST_F(ChangeGuard, AllFactorsNeedTheWheelThatTheyReferTo) {
  ParameterFile file;
  file.absolute = true;
  file.wheel = NominalWheel{0.072, 64 * 43.8};  // what the simulated robot believes in
  EXPECT_EQ(wrong_wheel(robot_, file), std::nullopt);
  file.wheel->diameter_m = 0.0721;
  EXPECT_THAT(wrong_wheel(robot_, file), Optional(Tells(UploadProblem::of_other_wheel,
                                                        HasSubstr("of 0.0721 m"), HasSubstr("of 0.072 m"))));
}

TEST_F(ChangeGuard, SaysThatAChangeWithinItsErrorMayBeForNothing) {
  const auto note = [&](const ParameterValues& values) {
    return insignificance(changes(robot_, values),
                          {{"c_R", 1e-4}, {"c_L", 1e-4}, {"b", std::nan("")}, {"e", 2e-3}});
  };
  EXPECT_THAT(note({{"c_R", 1.00019}, {"c_L", 0.99981}}), HasSubstr("twice its standard error"));
  EXPECT_EQ(note({{"c_R", 1.00019}, {"c_L", 0.9997}}), "");
  EXPECT_EQ(note({{"c_R", 1.00019}, {"b", 0.2901}}), "") << "nobody knows about b";
  EXPECT_EQ(note({{"kp", 80.0}}), "") << "a gain has no error";
  EXPECT_THAT(note({{"e", 0.0039}}), HasSubstr("twice its standard error"));
  EXPECT_EQ(note({{"e", 0.0041}}), "");
}

TEST_F(ChangeGuard, ObjectsInSentencesThatCanBeOverridden) {
  ParameterFile file;
  const auto objected = [&](double b_m) {
    return objections(robot_, {"ASTRO", "01"}, file, changes(robot_, {{"b", b_m}}));
  };
  EXPECT_THAT(objected(0.31), IsEmpty());
  EXPECT_THAT(objected(0.32), ElementsAre(Tells(UploadProblem::suspicious, "b", "+10.3")));
  file.loaded = {{"c_R", 1.001}};
  EXPECT_THAT(objected(0.31), ElementsAre(Tells(UploadProblem::of_other_factors, "c_R", "1.001", "1")));
}

TEST_F(ChangeGuard, NamesEachThingThatIsOverridden) {
  ParameterFile file;
  file.robot = {"ASTRO", "02"};
  file.wheel = NominalWheel{0.0721, 64 * 43.8};
  EXPECT_THAT(objections(robot_, {"ASTRO", "01"}, file, changes(robot_, {{"b", 0.32}})),
              ElementsAre(Tells(UploadProblem::of_other_robot, "02", "01"),
                          Tells(UploadProblem::of_other_wheel, HasSubstr("of 0.0721 m"), testing::_),
                          Tells(UploadProblem::suspicious, "b", "+10.3")));
}

TEST_F(ChangeGuard, ObjectsToFactorsThatAreNotAllThere) {
  ParameterFile file;
  const auto objected = [&] { return objections(robot_, {}, file, {}); };
  file.method = "ml";
  file.parameters = {{"c_R", 1.001}, {"c_L", 0.999}};
  EXPECT_THAT(objected(), ElementsAre(Tells(UploadProblem::incomplete, "b")));
  file.parameters["b"] = 0.29;
  EXPECT_THAT(objected(), IsEmpty());
  file = {};
  file.parameters = {{"c_R", 1.001}};
  EXPECT_THAT(objected(), IsEmpty()) << "no calibration, but somebody's own choice";
}

TEST_F(ChangeGuard, RefusesNamesAndValuesThatTheRobotDoesNotHave) {
  using robot::ParameterProblem;
  EXPECT_THAT([&] { changes(robot_, {{"c_X", 1.0}}); }, ThrowsTelling(ParameterProblem::unknown, "c_X"));
  EXPECT_THAT(
      [&] {
        changes(robot_, {{"c_R", 2.5}});
      },
      ThrowsTelling(ParameterProblem::out_of_range, "c_R", "2.5", testing::_));
  EXPECT_THAT(
      [&] {
        changes(robot_, {{"c_R", std::string("much")}});
      },
      ThrowsTelling(ParameterProblem::is_number, "c_R"));
}

TEST(SideBySide, SaysWhatAChangeMeansAndNeverMinusTwoHundredPercentOfASign) {
  const auto change = [](double before, double after) {
    return side_by_side({{"x", "", before, after}}).at(1).back();
  };
  EXPECT_EQ(change(1, -1), "reversed");
  EXPECT_EQ(change(-1, 1), "reversed");
  EXPECT_EQ(change(2, -1), "other sign");
  EXPECT_EQ(change(1, 1.00207), "+0.2070 %");
  EXPECT_EQ(change(60, 0), "-100.0000 %");
  EXPECT_EQ(change(0, 3), "");
  EXPECT_EQ(change(1, 1 - 1e-9), "< 0.0001 %");
  EXPECT_EQ(side_by_side({{"name", "", std::string("a"), std::string("b")}}).at(1).back(), "");
}

}  // namespace
}  // namespace astro::experiment
