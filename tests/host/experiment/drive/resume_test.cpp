#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "host/experiment/analysis/report_input.hpp"
#include "host/experiment/drive/open_journal.hpp"
#include "host/recording/run_file.hpp"
#include "host/robot/motion/drive_problem.hpp"
#include "host/robot/parameters/upload.hpp"
#include "host/truth/source/manual_source.hpp"
#include "tests/host/experiment/files/older_journal.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/desk.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;
using support::Desk;
using support::Tells;
using support::TemporaryFolder;
using support::thesis_robot;
using support::ThrowsTelling;
using testing::HasSubstr;

enum class Mishap { tracker_gone };

std::string no_answer(const truth::Question&) { throw Error("nobody is there"); }

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

TEST_F(Resume, AStopThatComesBetweenTwoRunsEndsTheExperimentWhichGoesOnWhenItIsStartedAgain) {
  robot::Client person(std::make_unique<simulation::InProcessTransport>(desk_.robot, 1));
  person.connect();
  int started = 0;
  ExperimentHooks hooks;
  hooks.run_started = [&](const RunSpec&, int, int) {
    if (++started == 2) person.request(protocol::Stop{});
  };
  EXPECT_THAT([&] { run(small_plan(), hooks); }, ThrowsTelling(robot::DriveProblem::stopped_by_another));
  EXPECT_EQ(started, 2);
  EXPECT_EQ(desk_.client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
  desk_.client.connect();  // as the next program does
  EXPECT_EQ(run(small_plan()).phases.size(), 2U);
}

/// A line that breaks once, while the robot is on its way.
class BreakingLine : public robot::Transport {
 public:
  BreakingLine(std::unique_ptr<robot::Transport> line, const bool& breaks)
      : line_(std::move(line)), breaks_(breaks) {}

  void write(std::span<const std::uint8_t> bytes) override {
    if (is_broken()) throw robot::LinkLost("the cable was pulled");
    line_->write(bytes);
  }
  std::size_t read(std::span<std::uint8_t> into, std::chrono::microseconds timeout) override {
    if (is_broken()) throw robot::LinkLost("the cable was pulled");
    return line_->read(into, timeout);
  }
  std::chrono::microseconds now() const override { return line_->now(); }
  const std::string& name() const override { return line_->name(); }
  void reopen(std::chrono::microseconds timeout) override {
    plugged_in_ = true;
    line_->reopen(timeout);
  }

 private:
  bool is_broken() const { return breaks_ && !plugged_in_; }

  std::unique_ptr<robot::Transport> line_;
  const bool& breaks_;
  bool plugged_in_ = false;
};

enum class Event { drives, asks_about };

/// An experiment whose line breaks when the second run has begun. `put_back`: whether somebody puts the robot back;
/// `interrupted`: whether somebody interrupts it at that moment.
std::vector<Remark> driven_over_a_line_that_breaks(const fs::path& folder, bool put_back,
                                                   bool interrupted = false) {
  Desk desk(thesis_robot(0, 1));
  bool breaks = false;
  robot::Client client(
      std::make_unique<BreakingLine>(std::make_unique<simulation::InProcessTransport>(desk.robot), breaks));
  client.connect();
  std::vector<Remark> events;
  ExperimentHooks hooks;
  hooks.run_started = [&](const RunSpec& spec, int, int) {
    events.push_back({"", Event::drives, {spec.title()}});
  };
  hooks.run.segment_done = [&](std::uint16_t) { breaks = events.size() > 1; };
  hooks.run.interrupted = [&] { return breaks && interrupted; };
  hooks.run.notice = [&](const Remark& remark) { events.push_back(remark); };
  hooks.put_back = [&](const RunSpec& spec) {
    events.push_back({"", Event::asks_about, {spec.title()}});
    const auto two_seconds_later = desk.robot->board().world_us() + 2'000'000;
    while (desk.robot->board().world_us() < two_seconds_later)
      desk.robot->step();  // it stops for want of commands
    return put_back;
  };
  try {
    run_experiment(client, desk.truth, small_plan(), folder, hooks);
  } catch (const Error& error) {
    events.push_back(error.remark());
  }
  return events;
}

TEST_F(Resume, AfterALostLinkTheRobotDoesNotDriveBeforeSomebodyHasPutItBack) {
  const char* second = "before: square ccw 1";
  const auto cable_pulled = testing::Field("sentence", &Remark::sentence, "the cable was pulled");
  EXPECT_THAT(driven_over_a_line_that_breaks(folder_.path(), false),
              testing::ElementsAre(Tells(Event::drives, "before: square cw 1"), Tells(Event::drives, second),
                                   Tells(robot::DriveProblem::stop_unconfirmed), cable_pulled,
                                   Tells(Event::asks_about, second),
                                   Tells(ExperimentProblem::broken_off, folder_.path().string(), second)));
}

TEST_F(Resume, ARunWhoseLinkWasLostIsDrivenAgainOnceTheRobotIsPutBack) {
  const std::vector<Remark> events = driven_over_a_line_that_breaks(folder_.path(), true);
  ASSERT_GE(events.size(), 7U);
  EXPECT_THAT(events[4], Tells(Event::asks_about, "before: square ccw 1"));
  EXPECT_THAT(events.back(), Tells(Event::drives, "after: square ccw 1"));
}

TEST_F(Resume, InterruptedOnceTheLinkIsLostItAsksNobodyAndDoesNotSayThatTheRobotStands) {
  EXPECT_THAT(driven_over_a_line_that_breaks(folder_.path(), true, true),
              testing::ElementsAre(Tells(Event::drives, "before: square cw 1"),
                                   Tells(Event::drives, "before: square ccw 1"),
                                   Tells(robot::DriveProblem::stop_unconfirmed)));
}

/// Ground truth of a simulator that ends in the middle of a run.
class TruthThatEnds : public truth::Source {
 public:
  explicit TruthThatEnds(truth::Source& truth) : truth_(truth) {}
  std::vector<recording::TruthSample> poll() override {
    if (ended) throw Error("the tracker is gone", Mishap::tracker_gone);
    return truth_.poll();
  }
  std::string name() const override { return truth_.name(); }
  std::string clock() const override { return truth_.clock(); }

  bool ended = false;

 private:
  truth::Source& truth_;
};

TEST_F(Resume, AfterALostTruthItSaysThatTheRobotStandsOnItsWay) {
  for (const bool on_the_way : {true, false}) {
    TruthThatEnds truth(desk_.truth);
    ExperimentHooks hooks;
    std::vector<Remark> notices;
    hooks.run_started = [&](const RunSpec&, int, int) { truth.ended = !on_the_way; };
    hooks.run.segment_done = [&](std::uint16_t) { truth.ended = true; };
    hooks.run.notice = [&](const Remark& notice) { notices.push_back(notice); };
    EXPECT_THAT([&] { run_experiment(desk_.client, truth, small_plan(), folder_.path(), hooks); },
                ThrowsTelling(Mishap::tracker_gone));
    const auto broken_off =
        Tells(ExperimentProblem::broken_off, folder_.path().string(), "before: square cw 1");
    EXPECT_EQ(std::ranges::any_of(notices, testing::Matches(broken_off)), on_the_way);
  }
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
  truth::ManualSource nobody(no_answer);
  for (int session = 0; session < 2; ++session)
    EXPECT_THAT([&] { run_experiment(desk_.client, nobody, plan, folder_.path(), hooks); },
                ThrowsTelling(ExperimentProblem::truth_missing, "nobody is there"));
  EXPECT_EQ(driven, 1);

  truth::ManualSource person([](const truth::Question&) { return "10"; });
  EXPECT_EQ(run_experiment(desk_.client, person, plan, folder_.path(), hooks).phases.size(), 2U);
  EXPECT_EQ(driven, 4);
  const recording::Run run = recording::read_run(folder_.path() / "before" / "square-cw-1.mcap");
  EXPECT_EQ(run.truth.back().x_m, 0.01);
  EXPECT_EQ(run.info.truth_source, "manual");
}

/// A person who measures about the same each time, and mistypes some answers: `mistyped` has them by the number of the run
/// that is measured, counted from 1.
class ATypingPerson {
 public:
  explicit ATypingPerson(std::map<int, std::string> mistyped) : mistyped_(std::move(mistyped)) {}
  std::string operator()(const truth::Question& question) {
    if (question.text.find("heading") != std::string::npos) return "";
    // A robot that ends ahead of its mark ends to the left of it after a clockwise square, and to the right after another.
    if (question.text.find("y, left") != std::string::npos)
      return std::to_string(sign_ * (60 + measured % 3));
    sign_ = question.text.find("ccw") == std::string::npos ? 1 : -1;
    ++measured;
    const auto typed = mistyped_.find(measured);
    return typed == mistyped_.end() ? std::to_string(60 + 2 * (measured % 3)) : typed->second;
  }
  int measured = 0;

 private:
  std::map<int, std::string> mistyped_;
  int sign_ = 1;
};

class DoubtfulTruth : public Resume {
 protected:
  /// What was asked about until the squares of the first phase were done: three clockwise, three counter-clockwise.
  void measure(
      ATypingPerson& person, const std::function<Redo(const DoubtfulRun&)>& doubt,
      const std::function<void(const RunSpec&, int, int)>& started = [](const RunSpec&, int, int) {}) {
    Plan plan = small_plan();
    plan.truth = "manual";
    plan.runs = 3;
    plan.order = Order::cw_first;
    ExperimentHooks hooks;
    hooks.doubt = [&](const DoubtfulRun& run) {
      asked.push_back(run.why);
      return doubt(run);
    };
    hooks.decide = [](const auto&, const auto&) { return Decision::later; };
    hooks.run_started = [&](const RunSpec& spec, int number, int total) {
      driven.push_back(spec.title());
      started(spec, number, total);
    };
    truth::ManualSource source(std::ref(person));
    EXPECT_THROW(run_experiment(desk_.client, source, plan, folder_.path(), hooks), Error);
  }
  double measured_m(const char* name) const {
    return recording::read_run(folder_.path() / "before" / name).truth.back().x_m;
  }
  std::vector<std::string> asked, driven;
};

constexpr auto kIsRight = [](const DoubtfulRun&) { return Redo::no; };
constexpr auto kEnterAgain = [](const DoubtfulRun&) { return Redo::enter_again; };
constexpr auto kDriveAgain = [](const DoubtfulRun&) { return Redo::drive_again; };

TEST_F(DoubtfulTruth, IsEnteredAgainAndNamesTheRunAndWhatWouldFit) {
  ATypingPerson person({{3, "600"}});
  measure(person, kEnterAgain);
  EXPECT_EQ(person.measured, 7) << "six squares, one of them twice";
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_THAT(asked[0], testing::AllOf(HasSubstr("before: square cw 3: x = 600 mm"),
                                       HasSubstr("x = 60 mm would fit (the decimal point of x)")));
  EXPECT_NEAR(measured_m("square-cw-3.mcap"), 0.062, 1e-9);
}

TEST_F(DoubtfulTruth, IsDrivenAgainIfSomebodyWantsIt) {
  ATypingPerson person({{3, "600"}});
  measure(person, kDriveAgain);
  EXPECT_EQ(std::ranges::count(driven, "before: square cw 3"), 2);
  EXPECT_NEAR(measured_m("square-cw-3.mcap"), 0.062, 1e-9);
}

TEST_F(DoubtfulTruth, IsKeptIfSomebodySaysThatItIsRightAndNotAskedAboutAgain) {
  ATypingPerson person({{3, "600"}});
  measure(person, kIsRight);
  EXPECT_EQ(person.measured, 6);
  EXPECT_EQ(asked.size(), 1U);
  measure(person, kIsRight);  // the experiment is taken up again
  EXPECT_EQ(asked.size(), 1U);
  EXPECT_NEAR(measured_m("square-cw-3.mcap"), 0.6, 1e-9);
}

TEST_F(DoubtfulTruth, OfAnEarlierSquareIsCorrectedOnceTheOthersShowIt) {
  // Side by side the first two contradict each other, and the person is sure of the second. The third settles it.
  ATypingPerson person({{1, "400"}});
  measure(person, [&](const DoubtfulRun& run) {
    return run.spec.index == 1 && person.measured >= 3 ? Redo::enter_again : Redo::no;
  });
  EXPECT_NEAR(measured_m("square-cw-1.mcap"), person.measured == 7 ? 0.062 : 0.4, 0.003);
  ASSERT_FALSE(asked.empty());
  EXPECT_THAT(asked.front(), HasSubstr("before: square cw 1: x = 400 mm"));
}

TEST_F(DoubtfulTruth, AfterAnInterruptionIsAskedAboutWhenTheExperimentGoesOn) {
  ATypingPerson person({{3, "600"}});
  measure(person, [](const DoubtfulRun&) -> Redo { throw Interrupted("Ctrl-C"); });
  EXPECT_EQ(driven.size(), 3U);
  measure(person, kEnterAgain);
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_EQ(asked[0], asked[1]);
  EXPECT_EQ(driven.size(), 6U) << "no drive was lost";
}

TEST_F(DoubtfulTruth, IsLookedForWithoutReadingARecordingAgain) {
  ATypingPerson person({{3, "600"}});
  const fs::path first = folder_.path() / "before" / "square-cw-1.mcap";
  measure(person, kIsRight, [&](const RunSpec& spec, int, int) {
    // It was read when the truth of the second square was entered.
    if (spec.index == 3) std::ofstream(first) << "no recording";
  });
  EXPECT_EQ(person.measured, 6) << "all squares were driven and measured";
  EXPECT_EQ(asked.size(), 1U) << "the third square is compared with the first two";
}

TEST_F(Resume, TheLastRunIsCorrectedOrDrivenAgainBeforeTheNext) {
  Plan plan = small_plan();
  plan.truth = "manual";
  plan.runs = 2;
  ATypingPerson person({});
  std::vector<Redo> wishes{Redo::enter_again, Redo::drive_again};
  std::vector<std::string> driven;
  ExperimentHooks hooks;
  hooks.ready = [&](const RunSpec&, const std::optional<RunSpec>& last) {
    if (!last || wishes.empty()) return Redo::no;
    const Redo wish = wishes.front();
    wishes.erase(wishes.begin());
    return wish;
  };
  hooks.decide = [](const auto&, const auto&) { return Decision::later; };
  hooks.run_started = [&](const RunSpec& spec, int, int) { driven.push_back(spec.title()); };
  truth::ManualSource source(std::ref(person));
  EXPECT_THAT([&] { run_experiment(desk_.client, source, plan, folder_.path(), hooks); },
              ThrowsTelling(ExperimentProblem::not_uploaded, folder_.path().string()));
  EXPECT_EQ(driven,
            (std::vector<std::string>{"before: square cw 1", "before: square cw 1", "before: square ccw 1",
                                      "before: square cw 2", "before: square ccw 2"}));
  EXPECT_EQ(person.measured, 6);
}

TEST_F(Resume, ARunThatIsDrivenAgainIsNotOfferedForCorrectionBeforeItIsDriven) {
  Plan plan = small_plan();
  plan.truth = "manual";
  truth::ManualSource person([](const truth::Question&) { return "10"; });
  std::vector<std::string> offered;
  ExperimentHooks hooks;
  hooks.ready = [&](const RunSpec& next, const std::optional<RunSpec>& last) {
    offered.push_back(next.title() + (last ? " after " + last->title() : ""));
    // Of the second run, and again if that is possible.
    return offered.size() == 2 || offered.size() == 3 ? Redo::drive_again : Redo::no;
  };
  EXPECT_EQ(run_experiment(desk_.client, person, plan, folder_.path(), hooks).phases.size(), 2U);
  ASSERT_GE(offered.size(), 4U);
  EXPECT_EQ(offered[1], "before: square ccw 1 after before: square cw 1");
  EXPECT_EQ(offered[2], "before: square cw 1");
  EXPECT_EQ(offered[3], "before: square ccw 1 after before: square cw 1");
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
  EXPECT_THAT([&] { run(other); }, ThrowsTelling(ExperimentProblem::other_settings, folder_.path().string()));
}

TEST_F(Resume, RefusesAnotherRobot) {
  interrupt_in_run(2);
  Desk other(thesis_robot(0, 2));
  EXPECT_THAT([&] { run_experiment(other.client, other.truth, small_plan(), folder_.path(), {}); },
              ThrowsTelling(ExperimentProblem::other_robot, folder_.path().string()));
}

TEST_F(Resume, RefusesARobotWhoseParametersChangedInTheMiddleOfAPhase) {
  interrupt_in_run(2);
  robot::upload(desk_.client, {{"c_R", 1.001}});
  EXPECT_THAT([&] { run(small_plan()); }, ThrowsTelling(ExperimentProblem::other_factors_loaded, "before",
                                                        HasSubstr("c_R 1.001"), HasSubstr("c_R 1.000")));
}

/// Squares hardly show an e, so the calibration between the phases has none.
TEST_F(Resume, ARobotWithAnEGoesOnWithItUntilACalibrationReplacesIt) {
  robot::upload(desk_.client, {{"e", 0.02}, {"kappa0", 0.2}});
  interrupt_in_run(2);
  const calibration::WheelFactors before = read_journal(folder_.path()).loaded.at("before");
  EXPECT_NEAR(before.e, 0.02, 1e-8);
  EXPECT_NEAR(before.kappa0, 0.2, 1e-8);
  const Results results = run(small_plan());
  ASSERT_EQ(results.phases.size(), 2U);
  EXPECT_NEAR(results.before().squares().loaded.e, 0.02, 1e-8);
  EXPECT_NEAR(results.after().squares().loaded.e, results.before().calibration->factors.e, 1e-8);
  EXPECT_LT(results.after().squares().loaded.e, 0.01) << "two small squares do not show it";
}

TEST_F(Resume, RefusesARobotWhoseEChangedInTheMiddleOfAPhase) {
  interrupt_in_run(2);
  robot::upload(desk_.client, {{"e", 0.02}});
  EXPECT_THAT([&] { run(small_plan()); },
              ThrowsTelling(ExperimentProblem::other_factors_loaded, "before", HasSubstr(" e 0.02"),
                            testing::Not(HasSubstr(" e "))));
}

TEST_F(Resume, AnExperimentFromBeforeThereWasAnEGoesOnWithoutOne) {
  interrupt_in_run(2);
  test::make_older_than_e(folder_.path());
  EXPECT_EQ(run(small_plan()).phases.size(), 2U);
}

TEST_F(Resume, AnExperimentFromBeforeThereWasAnEIsRefusedIfTheRobotHoldsOneByNow) {
  interrupt_in_run(2);
  test::make_older_than_e(folder_.path());
  robot::upload(desk_.client, {{"e", 0.02}});
  EXPECT_THAT([&] { run(small_plan()); },
              ThrowsTelling(ExperimentProblem::other_factors_loaded, "before", HasSubstr(" e 0.02"),
                            testing::Not(HasSubstr(" e "))));
}

/// What can have happened to a recording between two sessions.
enum class Harm { cut, cut_to_nothing, overwritten, zeroed_inside, of_another_run, removed };

void harm(const fs::path& file, Harm how, const fs::path& other) {
  const auto size = fs::file_size(file);
  if (how == Harm::cut) fs::resize_file(file, size / 2);
  if (how == Harm::cut_to_nothing) fs::resize_file(file, 0);
  if (how == Harm::overwritten) std::ofstream(file) << "no recording";
  if (how == Harm::of_another_run) fs::copy_file(other, file, fs::copy_options::overwrite_existing);
  if (how == Harm::removed) fs::remove(file);
  if (how != Harm::zeroed_inside) return;
  std::fstream inside(file, std::ios::in | std::ios::out | std::ios::binary);
  inside.seekp(static_cast<std::streamoff>(size / 2));
  inside << std::string(64, '\0');
}

class HarmedRecording : public Resume {
 protected:
  /// Goes on, and expects that this is refused without a metre driven or a parameter changed.
  void expect_refused(const fs::path& recording, ExperimentProblem problem) {
    const auto factors = [&] { return loaded_in_robot(); };
    const auto before = factors();
    ExperimentHooks hooks;
    hooks.run_started = [](const RunSpec& spec, int, int) { ADD_FAILURE() << "drives " << spec.title(); };
    hooks.uploaded = [](const Remark& remark) { ADD_FAILURE() << remark.sentence; };
    for (int session = 0; session < 2; ++session)
      EXPECT_THAT([&] { run(small_plan(), hooks); }, ThrowsTelling(problem, recording.string()));
    EXPECT_EQ(factors(), before);
  }
  std::map<std::string, double> loaded_in_robot() {
    return robot::RemoteParameters::fetch(desk_.client).numbers();
  }
};

TEST_F(HarmedRecording, OfThePhaseUnderWayIsNamedBeforeTheRobotDrives) {
  interrupt_in_run(2);
  const fs::path first = folder_.path() / "before" / "square-cw-1.mcap", whole = folder_.path() / "whole";
  fs::copy_file(first, whole);
  for (const Harm how : {Harm::cut, Harm::cut_to_nothing, Harm::overwritten, Harm::zeroed_inside}) {
    SCOPED_TRACE(static_cast<int>(how));
    fs::copy_file(whole, first, fs::copy_options::overwrite_existing);
    harm(first, how, {});
    expect_refused(first, how == Harm::cut ? ExperimentProblem::recording_cut_off
                                           : ExperimentProblem::recording_unusable);
  }
  fs::remove(first);
  EXPECT_EQ(run(small_plan()).phases.size(), 2U) << "what was removed is driven again";
}

TEST_F(HarmedRecording, OfAPhaseThatIsOverIsNamedBeforeTheRobotDrives) {
  interrupt_in_run(4);  // the second run of "after"
  const fs::path first = folder_.path() / "before" / "square-cw-1.mcap", whole = folder_.path() / "whole";
  fs::copy_file(first, whole);
  for (const Harm how : {Harm::cut, Harm::cut_to_nothing, Harm::overwritten, Harm::zeroed_inside,
                         Harm::of_another_run, Harm::removed}) {
    SCOPED_TRACE(static_cast<int>(how));
    fs::copy_file(whole, first, fs::copy_options::overwrite_existing);
    harm(first, how, folder_.path() / "before" / "square-ccw-1.mcap");
    expect_refused(first, ExperimentProblem::cannot_go_on);
  }
  fs::copy_file(whole, first, fs::copy_options::overwrite_existing);
  EXPECT_EQ(run(small_plan()).phases.size(), 2U);
}

TEST_F(HarmedRecording, OfTheDriveWhoseTruthIsMissingIsNamedBeforeAnybodyIsAsked) {
  Plan plan = small_plan();
  plan.truth = "manual";
  truth::ManualSource nobody(no_answer);
  EXPECT_THAT([&] { run_experiment(desk_.client, nobody, plan, folder_.path(), {}); },
              ThrowsTelling(ExperimentProblem::truth_missing, "nobody is there"));
  const fs::path drive = folder_.path() / "before" / "square-cw-1.mcap.no-truth";
  harm(drive, Harm::cut, {});
  truth::ManualSource person([](const truth::Question& question) {
    ADD_FAILURE() << question.text;
    return "10";
  });
  EXPECT_THAT([&] { run_experiment(desk_.client, person, plan, folder_.path(), {}); },
              ThrowsTelling(ExperimentProblem::recording_cut_off, drive.string()));
}

/// Ground truth that loses the robot in the first run.
class TruthThatLosesTheRobot : public TruthThatEnds {
 public:
  using TruthThatEnds::TruthThatEnds;
  std::vector<recording::TruthSample> poll() override {
    std::vector<recording::TruthSample> samples = TruthThatEnds::poll();
    for (recording::TruthSample& sample : samples) sample.valid = !lost;
    return samples;
  }
  bool lost = false;
};

TEST_F(Resume, ASquareWhoseEndTheTrackerDidNotSeeIsNamedBeforeTheNextIsDriven) {
  TruthThatLosesTheRobot truth(desk_.truth);
  int driven = 0;
  ExperimentHooks hooks;
  hooks.run_started = [&](const RunSpec&, int, int) { ++driven; };
  hooks.run.segment_done = [&](std::uint16_t) { truth.lost = true; };
  EXPECT_THAT([&] { run_experiment(desk_.client, truth, small_plan(), folder_.path(), hooks); },
              ThrowsTelling(ExperimentProblem::recording_unusable,
                            (folder_.path() / "before" / "square-cw-1.mcap").string()));
  EXPECT_EQ(driven, 1);
}

TEST_F(Resume, SaysThatADamagedJournalCannotBeResumed) {
  interrupt_in_run(2);
  std::ofstream(folder_.path() / "experiment.json") << "{";
  EXPECT_THAT([&] { run(small_plan()); },
              ThrowsTelling(JournalProblem::damaged, (folder_.path() / "experiment.json").string()));
}

}  // namespace
}  // namespace astro::experiment
