#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "host/recording/files/run_file.hpp"
#include "host/robot/parameters/upload.hpp"
#include "host/truth/manual/manual_source.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/desk.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;
using support::Desk;
using support::TemporaryFolder;
using support::thesis_robot;
using testing::HasSubstr;
using testing::Property;
using testing::ThrowsMessage;

Plan small_plan() {
  Plan plan;
  plan.runs = 1;
  plan.side_m = 1;
  plan.extras = false;
  plan.truth = "sim";
  return plan;
}

/// Interrupts the experiment while its n-th run is under way.
ExperimentHooks interrupted_in_run(int n, int& started) {
  ExperimentHooks hooks;
  hooks.run_started = [&started](const RunSpec&, int, int) { ++started; };
  hooks.run.interrupted = [&started, n] { return started >= n; };
  return hooks;
}

class Resume : public testing::Test {
 protected:
  Resume() : desk_(thesis_robot(0, 1)) {}

  Results run(const Plan& plan, const ExperimentHooks& hooks = {}) {
    return run_experiment(desk_.client, desk_.truth, plan, folder_.path(), hooks);
  }
  void interrupt_in_run(int n) {
    int started = 0;
    EXPECT_THROW(run(small_plan(), interrupted_in_run(n, started)), Interrupted);
  }

  Desk desk_;
  TemporaryFolder folder_;
};

TEST_F(Resume, DrivesOnlyWhatIsMissing) {
  interrupt_in_run(2);
  const fs::path first = folder_.path() / "before" / "square-cw-1.mcap";
  ASSERT_TRUE(fs::exists(first));
  const auto written = fs::last_write_time(first);

  std::vector<std::string> driven;
  ExperimentHooks hooks;
  hooks.run_started = [&](const RunSpec& spec, int, int) { driven.push_back(spec.title()); };
  const Results results = run(small_plan(), hooks);
  EXPECT_EQ(driven,
            (std::vector<std::string>{"before: square ccw 1", "after: square cw 1", "after: square ccw 1"}));
  EXPECT_EQ(fs::last_write_time(first), written);
  EXPECT_EQ(results.phases.size(), 2U);
}

TEST_F(Resume, AnInterruptedRobotStandsAndIsDisarmed) {
  interrupt_in_run(2);
  EXPECT_EQ(desk_.client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
}

TEST_F(Resume, GoesOnAfterTheUpload) {
  interrupt_in_run(3);  // the first run of "after"
  int started = 0;
  ExperimentHooks hooks;
  hooks.run_started = [&](const RunSpec&, int, int) { ++started; };
  hooks.uploaded = [](const Remark&) { FAIL() << "the robot holds the calibration already"; };
  run(small_plan(), hooks);
  EXPECT_EQ(started, 2);
}

TEST_F(Resume, ADriveOutlivesAPersonWhoWalksAwayFromTheTapeMeasure) {
  Plan plan = small_plan();
  plan.truth = "manual";
  int driven = 0;
  ExperimentHooks hooks;
  hooks.run_started = [&](const RunSpec&, int, int) { ++driven; };
  truth::ManualSource nobody([](const truth::Question&) -> std::string { throw Error("nobody is there"); });
  for (int session = 0; session < 2; ++session)
    EXPECT_THAT([&] { run_experiment(desk_.client, nobody, plan, folder_.path(), hooks); },
                support::ThrowsTelling("nobody is there; the drive is kept", Help::resume_for_truth));
  EXPECT_EQ(driven, 1);

  truth::ManualSource person([](const truth::Question&) { return "0.01"; });
  EXPECT_EQ(run_experiment(desk_.client, person, plan, folder_.path(), hooks).phases.size(), 2U);
  EXPECT_EQ(driven, 4);
  const recording::Run run = recording::read_run(folder_.path() / "before" / "square-cw-1.mcap");
  EXPECT_EQ(run.truth.back().x_m, 0.01);
  EXPECT_EQ(run.info.truth_source, "manual");
}

/// A person who measures about the same each time, and in one run forgets a decimal point.
class ATypingPerson {
 public:
  explicit ATypingPerson(int mistyped) : mistyped_(mistyped) {}
  std::string operator()(const truth::Question& question) {
    if (question.text.find("end x") == std::string::npos) return "0";
    ++measured;
    return measured == mistyped_ ? "0.6" : std::to_string(0.06 + 0.001 * (measured % 3));
  }
  int measured = 0;

 private:
  int mistyped_;
};

class MistypedTruth : public Resume {
 protected:
  /// What was asked about and what was noticed until the squares of the first phase were done.
  void measure(
      ATypingPerson& person, bool keep,
      const std::function<void(const RunSpec&, int, int)>& started = [](const RunSpec&, int, int) {}) {
    Plan plan = small_plan();
    plan.truth = "manual";
    plan.runs = 3;
    plan.order = Order::cw_first;
    ExperimentHooks hooks;
    hooks.keep = [&](const std::string& why) { return asked.push_back(why), keep; };
    hooks.run.notice = [&](const Remark& remark) { noticed.push_back(remark); };
    hooks.agree = [](const auto&, const auto&) { return false; };
    hooks.run_started = started;
    truth::ManualSource source(std::ref(person));
    EXPECT_THROW(run_experiment(desk_.client, source, plan, folder_.path(), hooks), Error);
  }
  std::vector<std::string> asked;
  std::vector<Remark> noticed;
};

TEST_F(MistypedTruth, OfTheThirdSquareIsAskedForAgainAndNamesTheRun) {
  ATypingPerson person(3);
  measure(person, false);
  EXPECT_EQ(person.measured, 7) << "six squares, one of them twice";
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_THAT(asked[0], testing::AllOf(HasSubstr("before: square cw 3: x = "), HasSubstr("in the others")));
}

TEST_F(MistypedTruth, IsKeptIfSomebodySaysThatItIsRight) {
  ATypingPerson person(3);
  measure(person, true);
  EXPECT_EQ(person.measured, 6);
  EXPECT_EQ(asked.size(), 1U);
}

TEST_F(MistypedTruth, OfAnEarlierSquareIsToldOnceWithItsRecording) {
  ATypingPerson person(1);
  measure(person, false);
  EXPECT_EQ(person.measured, 6);
  EXPECT_TRUE(asked.empty());
  ASSERT_EQ(noticed.size(), 1U);
  EXPECT_THAT(noticed[0],
              testing::AllOf(support::Tells(HasSubstr("before: square cw 1: x = "), Help::drive_run_again),
                             testing::Field(&Remark::remedy,
                                            testing::Field(&Remedy::value, HasSubstr("square-cw-1.mcap")))));
}

TEST_F(MistypedTruth, IsLookedForWithoutReadingARecordingAgain) {
  ATypingPerson person(3);
  const fs::path first = folder_.path() / "before" / "square-cw-1.mcap";
  measure(person, true, [&](const RunSpec& spec, int, int) {
    // It was read when the truth of the second square was entered.
    if (spec.index == 3) std::ofstream(first) << "no recording";
  });
  EXPECT_EQ(person.measured, 6) << "all squares were driven and measured";
  EXPECT_EQ(asked.size(), 1U) << "the third square is compared with the first two";
}

TEST_F(Resume, AFinishedExperimentDrivesNothing) {
  run(small_plan());
  ExperimentHooks hooks;
  hooks.run_started = [](const RunSpec& spec, int, int) { FAIL() << spec.title() << " is recorded already"; };
  EXPECT_EQ(run(small_plan(), hooks).phases.size(), 2U);
}

TEST_F(Resume, RefusesOtherSettings) {
  interrupt_in_run(2);
  Plan other = small_plan();
  other.side_m = 2;
  EXPECT_THAT([&] { run(other); }, ThrowsMessage<Error>(HasSubstr("other settings")));
}

TEST_F(Resume, RefusesAnotherRobot) {
  interrupt_in_run(2);
  Desk other(thesis_robot(0, 2));
  EXPECT_THAT([&] { run_experiment(other.client, other.truth, small_plan(), folder_.path(), {}); },
              support::ThrowsTelling(HasSubstr("is of robot"), Help::choose_other_out_folder));
}

TEST_F(Resume, RefusesARobotWhoseParametersChangedInTheMiddleOfAPhase) {
  interrupt_in_run(2);
  robot::upload(desk_.client, {{"c_R", 1.001}});
  EXPECT_THAT([&] { run(small_plan()); },
              ThrowsMessage<Error>(HasSubstr("phase 'before' of this experiment began")));
}

TEST_F(Resume, SaysThatADamagedJournalCannotBeResumed) {
  interrupt_in_run(2);
  std::ofstream(folder_.path() / "experiment.json") << "{";
  EXPECT_THAT([&] { run(small_plan()); }, ThrowsMessage<Error>(HasSubstr("experiment.json' is damaged")));
}

}  // namespace
}  // namespace astro::experiment
