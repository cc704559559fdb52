#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <fstream>
#include <numbers>

#include "host/experiment/drive/record_run.hpp"
#include "host/recording/end_error.hpp"
#include "host/truth/files/file_source.hpp"
#include "host/truth/source/manual_source.hpp"
#include "tests/support/base/person.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/desk.hpp"

// Ground truth that is only known after a run ends up as that run's end error, exactly.
namespace astro::experiment {
namespace {

using support::Desk;
using support::Person;
using support::Tells;
using testing::HasSubstr;
using truth::TruthFileProblem;

recording::Run drive_line(Desk& desk, truth::Source& source, const std::string& started_at = "") {
  recording::RunInfo info;
  info.started_at = started_at;
  info.kind = "line";
  info.phase = "before";
  info.index = 1;
  recording::Run run = record_run(desk.client, source, robot::line(0.5), info, {});
  EXPECT_TRUE(complete(run, source));
  return run;
}

constexpr truth::Units kMetres{truth::LengthUnit::m, truth::AngleUnit::deg};

TEST(ManualTruth, IsTheEndErrorOfTheRunInMillimetresAndDegreesUnlessTheNumberSaysOtherwise) {
  for (const auto& [units, answers] : {std::pair{truth::Units{}, std::deque<std::string>{"600", "-20", "3"}},
                                       {truth::Units{}, {"60 cm", "-0.02m", "0.05235987755982989 rad"}},
                                       {truth::Units{truth::LengthUnit::cm}, {" 60", "-20 mm ", "3°"}},
                                       {truth::Units{truth::LengthUnit::m, truth::AngleUnit::rad},
                                        {"0.6", "-0.02", "0.05235987755982989"}}}) {
    Desk desk{sim::Config{}};
    Person person(answers);
    truth::ManualSource source(std::ref(person), units);
    const recording::Run run = drive_line(desk, source);
    const recording::OdometrySample& end = run.odometry.back();
    const Pose2 error = recording::end_error(run);
    // 1e-6: the odometry at rest is averaged, and a robot that stands moves by less than that.
    EXPECT_NEAR(error.x_m, 0.6 - end.x_m, 1e-6);
    EXPECT_NEAR(error.y_m, -0.02 - end.y_m, 1e-6);
    EXPECT_NEAR(error.theta_rad, 3 * std::numbers::pi / 180 - end.theta_rad, 1e-6);
  }
}

TEST(ManualTruth, ShowsWhatOdometrySaysBesideEachQuestionInItsUnit) {
  Desk desk{sim::Config{}};
  Person person({"500", "0", ""});
  truth::ManualSource source(std::ref(person));
  drive_line(desk, source);
  ASSERT_EQ(person.asked.size(), 3U);
  EXPECT_THAT(person.asked[0], testing::AllOf(HasSubstr("line 1"), HasSubstr("mm (odometry 500.0 mm)")));
  EXPECT_THAT(person.asked[1], HasSubstr("mm (odometry 0.0 mm)"));
  EXPECT_THAT(person.asked[2], HasSubstr("deg (odometry 0.00 deg; empty: none)"));
}

TEST(ManualTruth, AsksAgainForWhatIsNoNumberAndTakesAnEmptyHeading) {
  Desk desk{sim::Config{}};
  Person person({"0,6", "0.6", "+0.01", ""});
  truth::ManualSource source(std::ref(person), kMetres);
  const Pose2 error = recording::end_error(drive_line(desk, source));
  EXPECT_EQ(person.asked.size(), 4U);
  EXPECT_THAT(person.asked[1], HasSubstr("'0,6' is not a number"));
  EXPECT_TRUE(std::isnan(error.theta_rad));
}

TEST(ManualTruth, BackBeginsAgainAndRedoWantsTheRunDrivenAgain) {
  Desk desk{sim::Config{}};
  Person person({"0.4", "0.2", "back", "0.6", "-0.02", "3"});
  truth::ManualSource source(std::ref(person), kMetres);
  const recording::Run run = drive_line(desk, source);
  EXPECT_NEAR(recording::end_error(run).y_m, -0.02 - run.odometry.back().y_m, 1e-6);

  Person tired({"0.4", "redo"});
  truth::ManualSource other(std::ref(tired), kMetres);
  EXPECT_FALSE(other.complete(run));
}

TEST(ManualTruth, AsksWhetherAnEndThatIsHardlyThatOfTheRunIsRightAndSaysWhatWouldFit) {
  Desk desk{sim::Config{}};
  // 500 for 0.5; then the heading in the wrong unit.
  Person person({"500", "-0.02", "3", "", "0.5", "-0.02", "170", "", "0.5", "-0.02", "3"});
  truth::ManualSource source(std::ref(person), kMetres);
  const Pose2 error = recording::end_error(drive_line(desk, source));
  EXPECT_NEAR(error.y_m, -0.02, 0.001);
  ASSERT_EQ(person.asked.size(), 11U);
  EXPECT_THAT(person.asked[3],
              testing::AllOf(HasSubstr("line 1"), HasSubstr("499.5 m from where odometry ends"),
                             HasSubstr("after a run of 0.5 m"), HasSubstr("x = 0.5 m would fit")));
  EXPECT_THAT(person.asked[7], HasSubstr("170 degrees from that of odometry"));
}

TEST(ManualTruth, KeepsAnImplausibleEndThatIsSaidToBeRight) {
  Desk desk{sim::Config{}};
  Person person({"2.5", "0", "", "y"});
  truth::ManualSource source(std::ref(person), kMetres);
  const recording::Run run = drive_line(desk, source);
  EXPECT_NEAR(recording::end_error(run).x_m, 2.5 - run.odometry.back().x_m, 1e-6);
}

class FileTruth : public testing::Test {
 protected:
  Pose2 error_with(const std::string& text) {
    std::ofstream(folder_.path() / "before-line-1.csv") << text;
    truth::FileSource source(folder_.path(), [](const truth::Question&) -> std::string {
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
  const Pose2 error = error_with("t,x_mm,y_mm,theta_deg\n0,1000,2000,90\n1,1000,2300,90\n2,1000,2500,90\n");
  EXPECT_NEAR(error.x_m, 0.5 - run_.odometry.back().x_m, 1e-6);
  EXPECT_NEAR(error.y_m, 0 - run_.odometry.back().y_m, 1e-6);
}

TEST_F(FileTruth, AsksAgainForAFileThatCannotBeReadNamingWhatIsWrongWithIt) {
  const std::filesystem::path file = folder_.path() / "before-line-1.csv";
  const std::vector<std::string> texts{"", "x,y\n0,0\n1,1\n", "x_m,y_m\n0,0\n", "x_m,y_m\n0,0\nnan,0\n",
                                       "x_m,y_m\n0,0\n0.5,0\n"};
  std::vector<truth::Question> asked;
  std::vector<truth::AnswerKind> answers;
  truth::FileSource source(folder_.path(), [&](const truth::Question& question) -> std::string {
    asked.push_back(question);
    answers.push_back(question.answer);
    std::ofstream(file) << texts.at(asked.size());
    return "";
  });
  run_ = drive_line(desk_, source);
  EXPECT_NEAR(recording::end_error(run_).x_m, 0.5 - run_.odometry.back().x_m, 1e-6)
      << "without headings the frame is that of the start";
  ASSERT_EQ(asked.size(), 4U);
  EXPECT_THAT(asked[0].text,
              testing::StartsWith("the ground truth of this run belongs into '" + file.string()));
  EXPECT_THAT(asked[1].occasion, Tells(TruthFileProblem::no_position, file.string(), "1"));
  EXPECT_THAT(asked[2].occasion, Tells(TruthFileProblem::too_few_poses, file.string()));
  EXPECT_THAT(asked[3].occasion, Tells(TruthFileProblem::not_a_number, file.string(), "3", "1", "nan"));
  for (int i : {1, 2, 3}) EXPECT_EQ(asked[i].text, "") << "the error says it all, and no key";
  using enum truth::AnswerKind;
  EXPECT_THAT(answers, testing::ElementsAre(file_saved, file_corrected, file_corrected, file_corrected));
}

TEST_F(FileTruth, SpreadsRowsByTheColumnOfTimeWhateverItsUnit) {
  for (const char* title : {"t", "time_ms", "Timestamp", "t_s"}) {
    error_with(std::string(title) + ",x_m,y_m\n100,0,0\n300,0.1,0\n500,0.5,0\n");
    const auto middle = std::find_if(run_.truth.begin(), run_.truth.end(),
                                     [](const auto& sample) { return sample.x_m == 0.1; });
    ASSERT_NE(middle, run_.truth.end());
    const auto half_us = (run_.odometry.front().time_us + run_.odometry.back().time_us) / 2;
    EXPECT_NEAR(static_cast<double>(middle->time_us), static_cast<double>(half_us), 1) << title;
  }
  error_with("t,x_m,y_m\n0,0,0\n1,0.1,0\n10,0.5,0\n");
  const auto early = std::find_if(run_.truth.begin(), run_.truth.end(),
                                  [](const auto& sample) { return sample.x_m == 0.1; });
  // Rows lie between 0.5 s after the start and 0.5 s before the end of the run.
  const double from = static_cast<double>(run_.odometry.front().time_us) + 5e5,
               to = static_cast<double>(run_.odometry.back().time_us) - 5e5;
  EXPECT_NEAR(static_cast<double>(early->time_us), from + 0.1 * (to - from), 1);
}

TEST_F(FileTruth, RefusesTimesThatAreNoneAndAnEndThatIsHardlyThatOfTheRun) {
  const std::filesystem::path file = folder_.path() / "before-line-1.csv";
  const std::vector<std::string> texts{"t,x_m,y_m\n0,0,0\n2,0.1,0\n1,0.5,0\n",
                                       "t,x_m,y_m\n0,0,0\nnoon,0.1,0\n2,0.5,0\n", "x_m,y_m\n0,0\n1000,0\n",
                                       "x_m,y_m\n0,0\n0.5,0\n"};
  std::ofstream(file) << texts[0];
  std::vector<truth::Question> asked;
  truth::FileSource source(folder_.path(), [&](const truth::Question& question) -> std::string {
    asked.push_back(question);
    std::ofstream(file) << texts.at(asked.size());
    return "";
  });
  run_ = drive_line(desk_, source);
  EXPECT_NEAR(recording::end_error(run_).x_m, 0.5 - run_.odometry.back().x_m, 1e-6);
  ASSERT_EQ(asked.size(), 3U);
  EXPECT_THAT(asked[0].occasion, Tells(TruthFileProblem::time_not_increasing, file.string(), "4"));
  EXPECT_THAT(asked[1].occasion, Tells(TruthFileProblem::not_a_number, file.string(), "3", "1", "noon"));
  EXPECT_THAT(asked[2].text,
              testing::AllOf(HasSubstr("before-line-1.csv"), HasSubstr("999.5 m from where odometry ends")));
}

TEST_F(FileTruth, KeepsAnImplausibleEndOfAFileThatIsLeftAsItIs) {
  std::ofstream(folder_.path() / "before-line-1.csv") << "x_m,y_m\n0,0\n2.5,0\n";
  std::vector<truth::AnswerKind> asked;
  truth::FileSource source(folder_.path(), [&](const truth::Question& question) -> std::string {
    return asked.push_back(question.answer), "";
  });
  run_ = drive_line(desk_, source);
  EXPECT_THAT(asked, testing::ElementsAre(truth::AnswerKind::file_corrected_or_kept));
  EXPECT_NEAR(recording::end_error(run_).x_m, 2.5 - run_.odometry.back().x_m, 1e-6);
}

TEST_F(FileTruth, OfAnEarlierRunIsNotThatOfThisOne) {
  const std::filesystem::path file = folder_.path() / "before-line-1.csv";
  const auto written_at = [&](int second) {
    std::ofstream(file) << "x_m,y_m\n0,0\n0.5,0\n";
    const std::chrono::sys_seconds start = std::chrono::sys_days(std::chrono::year(2026) / 3 / 1);
    const auto time = start + std::chrono::seconds(second);
    std::filesystem::last_write_time(file, std::chrono::file_clock::from_sys(time));
  };
  std::vector<std::string> asked;
  std::vector<truth::AnswerKind> answers;
  truth::FileSource source(folder_.path(), [&](const truth::Question& question) -> std::string {
    asked.push_back(question.text);
    answers.push_back(question.answer);
    if (asked.size() == 2) written_at(28);  // while it drives; the start is at 30 s, and file systems round
    return "";
  });
  written_at(27);
  run_ = drive_line(desk_, source, "2026-03-01T00:00:30Z");
  EXPECT_NEAR(recording::end_error(run_).x_m, 0.5 - run_.odometry.back().x_m, 1e-6);
  EXPECT_THAT(answers, testing::ElementsAre(truth::AnswerKind::file_saved, truth::AnswerKind::file_saved));
  EXPECT_THAT(asked,
              testing::Each(testing::AllOf(HasSubstr(file.string()), HasSubstr("2026-03-01T00:00:27Z"),
                                           HasSubstr("before this run began at 2026-03-01T00:00:30Z"))));
}

TEST_F(FileTruth, ThatIsMissingIsToldWithItsFolderOrItsName) {
  const std::filesystem::path folder = folder_.path() / "truth", file = folder / "before-line-1.csv";
  std::vector<std::string> asked;
  truth::FileSource source(folder, [&](const truth::Question& question) -> std::string {
    asked.push_back(question.occasion.sentence + question.text);
    if (asked.size() == 2) std::filesystem::create_directory(folder);
    if (asked.size() == 3) std::ofstream(file) << "x_m,y_m\n0,0\n0.5,0\n";
    return "";
  });
  run_ = drive_line(desk_, source);
  ASSERT_EQ(asked.size(), 3U);
  for (int i : {0, 1}) EXPECT_THAT(asked[i], HasSubstr("there is no folder '" + folder.string() + "'"));
  EXPECT_THAT(asked[2], HasSubstr("there is no file '" + file.string() + "'"));
}

}  // namespace
}  // namespace astro::experiment
