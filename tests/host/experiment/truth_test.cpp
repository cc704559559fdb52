#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <fstream>
#include <numbers>

#include "host/experiment/record_run.hpp"
#include "host/recording/end_error.hpp"
#include "host/truth/file_source.hpp"
#include "host/truth/manual_source.hpp"
#include "tests/support/desk.hpp"

// Ground truth that is only known after a run ends up as that run's end error, exactly.
namespace astro::experiment {
namespace {

using support::Desk;
using testing::HasSubstr;

recording::Run drive_line(Desk& desk, truth::Source& source) {
  recording::RunInfo info;
  info.kind = "line";
  info.phase = "before";
  info.index = 1;
  recording::Run run = record_run(desk.client, source, link::line(0.5), info, {});
  complete(run, source);
  return run;
}

/// Answers in order, keeps what was asked.
class Person {
 public:
  explicit Person(std::deque<std::string> answers) : answers_(std::move(answers)) {}
  std::string operator()(const std::string& prompt) {
    asked.push_back(prompt);
    const std::string answer = answers_.front();
    answers_.pop_front();
    return answer;
  }
  std::vector<std::string> asked;

 private:
  std::deque<std::string> answers_;
};

TEST(ManualTruth, IsTheEndErrorOfTheRun) {
  Desk desk{sim::Config{}};
  Person person({"0.6", "-0.02", "3"});
  truth::ManualSource source(std::ref(person));
  const recording::Run run = drive_line(desk, source);
  const recording::OdometrySample& end = run.odometry.back();
  const recording::EndError error = recording::end_error(run);
  // 1e-6: the odometry at rest is averaged, and a robot that stands moves by less than that.
  EXPECT_NEAR(error.x_m, 0.6 - end.x_m, 1e-6);
  EXPECT_NEAR(error.y_m, -0.02 - end.y_m, 1e-6);
  EXPECT_NEAR(error.theta_rad, 3 * std::numbers::pi / 180 - end.theta_rad, 1e-6);
}

TEST(ManualTruth, AsksAgainForWhatIsNoNumberAndTakesAnEmptyHeading) {
  Desk desk{sim::Config{}};
  Person person({"0,6", "0.6", "+0.01", ""});
  truth::ManualSource source(std::ref(person));
  const recording::EndError error = recording::end_error(drive_line(desk, source));
  EXPECT_EQ(person.asked.size(), 4U);
  EXPECT_THAT(person.asked[1], HasSubstr("'0,6' is no number"));
  EXPECT_TRUE(std::isnan(error.theta_rad));
}

class FileTruth : public testing::Test {
 protected:
  recording::EndError error_with(const std::string& text) {
    std::ofstream(folder_.path() / "before-line-1.csv") << text;
    truth::FileSource source(folder_.path(), [](const std::string&) -> std::string {
      ADD_FAILURE() << "the file is there: nobody is to be asked";
      return "";
    });
    run_ = drive_line(desk_, source);
    return recording::end_error(run_);
  }
  Desk desk_{sim::Config{}};
  support::TemporaryFolder folder_;
  recording::Run run_;
};

TEST_F(FileTruth, TakesFirstAndLastRowAsStartAndEndInAnyFrameAndUnit) {
  // Start at (1, 2) m facing +y; the robot ends 0.5 m further that way.
  const recording::EndError error =
      error_with("t,x_mm,y_mm,theta_deg\n0,1000,2000,90\n1,1000,2300,90\n2,1000,2500,90\n");
  EXPECT_NEAR(error.x_m, 0.5 - run_.odometry.back().x_m, 1e-6);
  EXPECT_NEAR(error.y_m, 0 - run_.odometry.back().y_m, 1e-6);
}

TEST_F(FileTruth, AsksAgainForAFileThatCannotBeReadNamingWhatIsWrongWithIt) {
  const std::filesystem::path file = folder_.path() / "before-line-1.csv";
  const std::vector<std::string> texts{"", "x,y\n0,0\n1,1\n", "x_m,y_m\n0,0\n", "x_m,y_m\n0,0\nnan,0\n",
                                       "x_m,y_m\n0,0\n0.5,0\n"};
  std::vector<std::string> asked;
  truth::FileSource source(folder_.path(), [&](const std::string& prompt) -> std::string {
    asked.push_back(prompt);
    std::ofstream(file) << texts.at(asked.size());
    return "";
  });
  run_ = drive_line(desk_, source);
  EXPECT_NEAR(recording::end_error(run_).x_m, 0.5 - run_.odometry.back().x_m, 1e-6)
      << "without headings the frame is that of the start";
  ASSERT_EQ(asked.size(), 4U);
  EXPECT_THAT(asked[0], testing::StartsWith("save the ground truth of this run as '" + file.string()));
  EXPECT_THAT(asked[1], testing::AllOf(HasSubstr("before-line-1.csv"), HasSubstr("x_m or x_mm"),
                                       HasSubstr("correct the file")));
  EXPECT_THAT(asked[2], HasSubstr("fewer than two poses"));
  EXPECT_THAT(asked[3], HasSubstr("line 3"));
}

}  // namespace
}  // namespace astro::experiment
