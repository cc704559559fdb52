#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "host/link/upload.hpp"
#include "host/recording/run_file.hpp"
#include "host/truth/manual_source.hpp"
#include "tests/support/desk.hpp"

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
    EXPECT_THROW(run(small_plan(), interrupted_in_run(n, started)), link::Interrupted);
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
  hooks.uploaded = [](const std::string&) { FAIL() << "the robot holds the calibration already"; };
  run(small_plan(), hooks);
  EXPECT_EQ(started, 2);
}

TEST_F(Resume, ADriveOutlivesAPersonWhoWalksAwayFromTheTapeMeasure) {
  Plan plan = small_plan();
  plan.truth = "manual";
  int driven = 0;
  ExperimentHooks hooks;
  hooks.run_started = [&](const RunSpec&, int, int) { ++driven; };
  truth::ManualSource nobody([](const std::string&) -> std::string { throw Error("nobody is there"); });
  for (int session = 0; session < 2; ++session)
    EXPECT_THAT([&] { run_experiment(desk_.client, nobody, plan, folder_.path(), hooks); },
                ThrowsMessage<Error>(HasSubstr("nobody is there; the drive is kept")));
  EXPECT_EQ(driven, 1);

  truth::ManualSource person([](const std::string&) { return "0.01"; });
  EXPECT_EQ(run_experiment(desk_.client, person, plan, folder_.path(), hooks).phases.size(), 2U);
  EXPECT_EQ(driven, 4);
  const recording::Run run = recording::read_run(folder_.path() / "before" / "square-cw-1.mcap");
  EXPECT_EQ(run.truth.back().x_m, 0.01);
  EXPECT_EQ(run.info.truth_source, "manual");
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
              ThrowsMessage<Error>(HasSubstr("choose another --out")));
}

TEST_F(Resume, RefusesARobotWhoseParametersChangedInTheMiddleOfAPhase) {
  interrupt_in_run(2);
  link::upload(desk_.client, {{"c_R", 1.001}});
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
