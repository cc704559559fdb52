#include "host/experiment/calibration_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "host/experiment/change_guard.hpp"
#include "tests/support/desk.hpp"

namespace astro::experiment {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class CalibrationFile : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) const {
    const std::filesystem::path path = folder_.path() / "calib.toml";
    std::ofstream(path) << text;
    return path;
  }
  support::TemporaryFolder folder_;
};

TEST_F(CalibrationFile, KeepsAnEstimateToTheLastBit) {
  calibration::Estimate estimate;
  estimate.factors = {1.0020770312345678, 0.9979229687654322, 0.2886110512345678};
  estimate.carried = {1, 1, 0.29};
  estimate.se.c_r = std::nan("");
  const std::filesystem::path path = folder_.path() / "calib.toml";
  write_calibration(path, estimate);
  const ParameterFile read = read_parameter_file(path);
  EXPECT_EQ(std::get<double>(read.parameters.at("c_R")), estimate.factors.c_r);
  EXPECT_EQ(std::get<double>(read.parameters.at("c_L")), estimate.factors.c_l);
  EXPECT_EQ(std::get<double>(read.parameters.at("b")), estimate.factors.b_m);
  EXPECT_EQ(read.carried.at("b"), 0.29);
}

TEST_F(CalibrationFile, KeepsTextAndNumbersOfAnExport) {
  const ParameterValues values{{"robot_name", std::string("R2 \"D2\"")}, {"kp", 40.0}};
  const std::filesystem::path path = folder_.path() / "robot.toml";
  write_parameters(path, values);
  EXPECT_EQ(read_parameter_file(path).parameters, values);
}

TEST_F(CalibrationFile, NamesTheFileThatIsNotThere) {
  EXPECT_THAT([] { read_parameter_file("/nowhere/calib.toml"); },
              ThrowsMessage<Error>(HasSubstr("/nowhere/calib.toml")));
}

TEST_F(CalibrationFile, NamesFileAndLineOfWhatIsNotToml) {
  const auto path = file("[parameters]\nc_R = = 1\n");
  EXPECT_THAT([&] { read_parameter_file(path); },
              ThrowsMessage<Error>(AllOf(HasSubstr("calib.toml"), HasSubstr("line 2"))));
}

TEST_F(CalibrationFile, SaysThatAFileHasNoParameters) {
  for (const char* text : {"", "a = 1\n", "[parameters]\n", "parameters = 1\n"}) {
    const auto path = file(text);
    EXPECT_THAT([&] { read_parameter_file(path); }, ThrowsMessage<Error>(HasSubstr("has no [parameters]")))
        << text;
  }
}

TEST_F(CalibrationFile, NamesTheValueThatIsNeitherNumberNorText) {
  const auto path = file("[parameters]\nc_R = [1, 2]\n");
  EXPECT_THAT([&] { read_parameter_file(path); }, ThrowsMessage<Error>(HasSubstr("c_R is neither")));
}

class ChangeGuard : public testing::Test {
 protected:
  ChangeGuard() : desk_(sim::Config{}), robot_(link::RemoteParameters::fetch(desk_.client)) {}
  support::Desk desk_;
  link::RemoteParameters robot_;
};

TEST_F(ChangeGuard, LeavesOutWhatTheRobotHoldsAlready) {
  const auto list = changes(robot_, {{"c_R", 1.0}, {"c_L", 0.999}});
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].name, "c_L");
  EXPECT_EQ(std::get<double>(list[0].before), 1.0);
}

TEST_F(ChangeGuard, DoubtsWheelFactorsThatMoveByMoreThanATenth) {
  EXPECT_THAT(suspicion(changes(robot_, {{"b", 0.32}})), HasSubstr("b would change by +10.3 %"));
  EXPECT_EQ(suspicion(changes(robot_, {{"b", 0.31}})), "");
  EXPECT_EQ(suspicion(changes(robot_, {{"kp", 80.0}})), "") << "a gain may change as it likes";
}

TEST_F(ChangeGuard, RefusesNamesAndValuesThatTheRobotDoesNotHave) {
  EXPECT_THAT([&] { changes(robot_, {{"c_X", 1.0}}); }, ThrowsMessage<Error>(HasSubstr("c_X")));
  EXPECT_THAT([&] { changes(robot_, {{"c_R", 2.5}}); }, ThrowsMessage<Error>(HasSubstr("c_R")));
  EXPECT_THAT(
      [&] {
        changes(robot_, {{"c_R", std::string("much")}});
      },
      ThrowsMessage<Error>(HasSubstr("c_R")));
}

}  // namespace
}  // namespace astro::experiment
