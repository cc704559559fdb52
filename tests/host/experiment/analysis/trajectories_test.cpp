#include "host/experiment/analysis/trajectories.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/recordings.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/experiment/files/run_set_problem.hpp"
#include "host/recording/run_file.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/desk.hpp"

namespace astro::experiment {
namespace {

using support::ThrowsTelling;
using testing::ElementsAre;

// A run that says all that is needed; its wheel makes 1000 counts a turn.
recording::Run followed_run() {
  recording::Run run;
  run.info.kind = "free";
  run.info.truth_source = "sim";
  run.info.truth_clock = "robot";
  run.info.robot_id = "a";
  run.info.parameters = {{"c_R", 1.01},
                         {"c_L", 0.99},
                         {"b", 0.29},
                         {"wheel_diameter", 0.1},
                         {"gear_numerator", 50},
                         {"gear_denominator", 5},
                         {"counts_per_motor_rev", 100}};
  return run;
}

void add_odometry(recording::Run& run, std::int64_t time_us, std::int32_t left, std::int32_t right) {
  recording::OdometrySample sample;
  sample.time_us = time_us;
  sample.left_counts = left;
  sample.right_counts = right;
  run.odometry.push_back(sample);
}

TEST(Trajectories, TravelIsThatOfANominalWheelWhateverTheRobotCarried) {
  recording::Run run = followed_run();
  add_odometry(run, 5'000'000, 100, -100);
  add_odometry(run, 5'100'000, 1100, -350);
  const calibration::Trajectory trajectory = trajectory_of(run, "x");
  ASSERT_EQ(trajectory.wheels.size(), 2U);
  // 100 counts x 50 / 5: 1000 counts are one turn of the wheel.
  EXPECT_DOUBLE_EQ(trajectory.wheels[1].left_m, std::numbers::pi * 0.1);
  EXPECT_DOUBLE_EQ(trajectory.wheels[1].right_m, -std::numbers::pi * 0.1 / 4);
  EXPECT_DOUBLE_EQ(trajectory.wheels[1].time_s - trajectory.wheels[0].time_s, 0.1);
}

TEST(Trajectories, KnowTheDateOfARecordingAndOfTimesSince1970) {
  recording::Run run = followed_run();
  add_odometry(run, 5'000'000, 0, 0);
  add_odometry(run, 5'100'000, 10, 10);
  EXPECT_FALSE(trajectory_of(run, "x").started_s) << "the robot was switched on five seconds ago";
  run.truth = {{1'700'000'000'000'000, 0, 0, 0}, {1'700'000'000'100'000, 0, 0, 0}};
  EXPECT_EQ(trajectory_of(run, "x").started_s, 1.7e9);
  run.info.started_at = "2026-03-01T12:00:00Z";
  EXPECT_EQ(trajectory_of(run, "x").started_s, 1'772'366'400.0);
}

TEST(Trajectories, CountsMayWrap) {
  recording::Run run = followed_run();
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  add_odometry(run, 0, kMost - 9, kLeast + 9);
  add_odometry(run, 10'000, kLeast + 990, kMost - 990);
  const calibration::Trajectory trajectory = trajectory_of(run, "x");
  EXPECT_DOUBLE_EQ(trajectory.wheels[1].left_m, std::numbers::pi * 0.1);
  EXPECT_DOUBLE_EQ(trajectory.wheels[1].right_m, -std::numbers::pi * 0.1);
}

TEST(Trajectories, LeaveOutWhatTheTrackerHadLost) {
  recording::Run run = followed_run();
  add_odometry(run, 1'000'000, 0, 0);
  const double lost = std::nan("");
  run.truth = {{1'010'000, 1, 2, 3, true}, {1'020'000, lost, lost, lost, false}, {1'030'000, 4, 5, 6, true}};
  const calibration::Trajectory trajectory = trajectory_of(run, "x");
  ASSERT_EQ(trajectory.truth.size(), 2U);
  EXPECT_NEAR(trajectory.truth[1].time_s - trajectory.wheels[0].time_s, 0.03, 1e-12);
  EXPECT_EQ(trajectory.truth[1].y_m, 5);
  EXPECT_FALSE(trajectory.ends_only) << "the robot moved at the times of what is left";
  run.truth.erase(run.truth.begin() + 1);
  EXPECT_TRUE(trajectory_of(run, "x").ends_only);
}

TEST(Trajectories, ATapeMeasureAndAFileOfEndPosesFollowNobody) {
  recording::Run run = followed_run();
  EXPECT_TRUE(has_moving_truth(run.info));
  for (const auto& [source, clock] :
       {std::pair{"manual", "robot"}, {"file", "start and end of the run"}, {"", ""}}) {
    run.info.truth_source = source;
    run.info.truth_clock = clock;
    EXPECT_FALSE(has_moving_truth(run.info)) << source;
  }
  EXPECT_THAT([&] { trajectory_of(run, "line-1"); },
              ThrowsTelling(AnalysisProblem::run_without_truth, "line-1"));
}

TEST(Trajectories, NameTheRecordingThatCannotBeUsed) {
  recording::Run run = followed_run();
  EXPECT_THAT([&] { trajectory_of(run, "a/b"); }, ThrowsTelling(AnalysisProblem::no_odometry, "a/b"));
  add_odometry(run, 20'000, 0, 0);
  add_odometry(run, 10'000, 0, 0);
  EXPECT_THAT([&] { trajectory_of(run, "a/b"); },
              ThrowsTelling(AnalysisProblem::times_run_backwards, "a/b", "odometry"));
  run.info.parameters.erase("wheel_diameter");
  EXPECT_THAT([&] { trajectory_of(run, "a/b"); },
              ThrowsTelling(AnalysisProblem::file_lacks_parameter, "a/b", "wheel_diameter"));
}

TEST(Recordings, ConvertTheirCountsOnceAndKeepWhatTheyGave) {
  recording::Run run = followed_run();
  add_odometry(run, 0, 0, 0);
  const Recordings recordings(RunSet{{"one", "two"}, {run, run}});
  EXPECT_EQ(recordings.trajectories().size(), 2U);
  EXPECT_EQ(recordings.trajectories().data(), recordings.trajectories().data());
  EXPECT_THAT([&] { (void)recordings.squares(); }, ThrowsTelling(AnalysisProblem::no_squares));
}

TEST(Recordings, ThatAreAddedToConvertTheNewRunsOnly) {
  recording::Run run = followed_run();
  add_odometry(run, 0, 0, 0);
  Recordings recordings(RunSet{{"one"}, {run}});
  const calibration::WheelSample* first = recordings.trajectories()[0].wheels.data();
  add_odometry(run, 10'000, 1000, 1000);
  recordings.add(RunSet{{"two"}, {run}});
  const std::vector<calibration::Trajectory>& all = recordings.trajectories();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].wheels.data(), first) << "the samples are those of before";
  EXPECT_EQ(all[1].name, "two");
  EXPECT_EQ(all[1].wheels.size(), 2U);
}

TEST(Trajectories, RefuseRunsWhoseFactorsWouldReferToDifferentThings) {
  recording::Run run = followed_run();
  add_odometry(run, 0, 0, 0);
  RunSet set{{"one", "two"}, {run, run}};
  set.runs[1].info.parameters["c_R"] = 1.02;
  EXPECT_EQ(trajectories_of(set).size(), 2U) << "other factors are no reason: they are not used";
  set.runs[1].info.parameters["wheel_diameter"] = 0.11;
  EXPECT_THAT([&] { trajectories_of(set); },
              ThrowsTelling(AnalysisProblem::runs_of_different_wheels, "one", "two"));
  set.runs[1] = run;
  set.runs[1].info.robot_id = "b";
  EXPECT_THAT([&] { trajectories_of(set); },
              ThrowsTelling(AnalysisProblem::runs_of_different_robots, "one", "two"));
}

class RunSets : public testing::Test {
 protected:
  RunSets() {
    for (const char* name :
         {"before/square-cw-1", "before/square-cw-10", "before/square-cw-2", "line-1", "after/square-cw-1"}) {
      const std::filesystem::path path = folder_.path() / (std::string(name) + ".mcap");
      std::filesystem::create_directories(path.parent_path());
      recording::write_run(path, followed_run());
    }
  }
  std::vector<std::string> names(const std::vector<std::string>& without) const {
    return read_run_set(folder_.path(), without).names;
  }
  support::TemporaryFolder folder_;
};

TEST_F(RunSets, AreNamedByTheirPathAndInNaturalOrder) {
  EXPECT_THAT(names({}), ElementsAre("after/square-cw-1", "before/square-cw-1", "before/square-cw-2",
                                     "before/square-cw-10", "line-1"));
}

TEST_F(RunSets, LeaveOutByPathAndByNameWhereThatIsClear) {
  EXPECT_THAT(names({"square-cw-2", "before/square-cw-1"}),
              ElementsAre("after/square-cw-1", "before/square-cw-10", "line-1"));
}

TEST_F(RunSets, RefuseNamesThatNobodyOrMoreThanOneHas) {
  EXPECT_THAT([&] { names({"square-ccw-1"}); },
              ThrowsTelling(RunSetProblem::no_such_name, "square-ccw-1", "after/square-cw-1",
                            "before/square-cw-1", "before/square-cw-2", "before/square-cw-10", "line-1"));
  EXPECT_THAT([&] { names({"square-cw-1"}); }, ThrowsTelling(RunSetProblem::ambiguous_name, "square-cw-1",
                                                             "after/square-cw-1", "before/square-cw-1"));
}

TEST(Trajectories, AreOfTheSessionsThatTheirSetNames) {
  const auto drive = [] {
    recording::Run run = followed_run();
    add_odometry(run, 0, 0, 0);
    return run;
  };
  Recordings recordings(RunSet{{"one", "two"}, {drive(), drive()}, {"monday", "tuesday"}});
  recordings.add(RunSet{{"three"}, {drive()}, {"monday"}});
  std::vector<std::string> sessions;
  for (const calibration::Trajectory& run : recordings.trajectories()) sessions.push_back(run.session);
  EXPECT_THAT(sessions, ElementsAre("monday", "tuesday", "monday"));
  // Nothing is said: the estimator finds them.
  EXPECT_EQ(trajectories_of(RunSet{{"one"}, {drive()}}).front().session, "");
}

}  // namespace
}  // namespace astro::experiment
