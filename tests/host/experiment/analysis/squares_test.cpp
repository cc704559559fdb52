#include "host/experiment/analysis/squares.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/recordings.hpp"
#include "host/recording/end_error.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::experiment {
namespace {

using support::ThrowsTelling;

recording::Run square() {
  recording::Run run;
  run.info.kind = "square";
  run.info.direction = Sense::cw;
  run.info.phase = "before";
  run.info.index = 3;
  run.info.size_m = 2;
  run.info.parameters = {{"c_R", 1.01}, {"c_L", 0.99}, {"b", 0.29}};
  // At rest at both ends, a straight metre and back to the start in between.
  for (int i = 0; i <= 100; ++i) {
    const double x_m = i < 25 || i > 75 ? 0 : 1 - std::abs(i - 50) / 25.0;
    const int counts = static_cast<int>(1000 * x_m);
    run.odometry.push_back({10'000 * i, x_m, 0, 0, 0, 0, counts, counts});
    run.truth.push_back({10'000 * i, x_m, 0, 0, true});
  }
  return run;
}

TEST(Squares, RefuseARecordingThatDoesNotSayWhatWasLoaded) {
  for (const char* name : {"c_R", "c_L", "b"}) {
    recording::Run run = square();
    run.info.parameters.erase(name);
    EXPECT_THAT(
        [&] {
          squares_of({&run, 1});
        },
        ThrowsTelling(AnalysisProblem::run_lacks_parameter, "run square cw 3 (before)", name));
  }
}

TEST(Squares, RefuseAParameterThatNoRobotCanHave) {
  for (const double value :
       {0.0, -0.29, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    recording::Run run = square();
    run.info.parameters["b"] = value;
    EXPECT_THAT(
        [&] {
          squares_of({&run, 1});
        },
        ThrowsTelling(AnalysisProblem::run_lacks_parameter, "run square cw 3 (before)", "b"))
        << value;
  }
}

TEST(Squares, AreNamedByTheirFiles) {
  recording::Run run = square();
  run.info.parameters.erase("b");
  const Recordings lacking(RunSet{{"before/cw-3"}, {run}});
  EXPECT_THAT([&] { (void)lacking.squares(); },
              ThrowsTelling(AnalysisProblem::file_lacks_parameter, "before/cw-3", "b"));
  run = square();
  run.truth.clear();
  const Recordings blind(RunSet{{"before/cw-3"}, {run}});
  EXPECT_THAT([&] { (void)blind.squares(); },
              ThrowsTelling(recording::EndProblem::no_truth, "before/cw-3", "start"));
}

TEST(LoadedFactors, OfAllRunsMayDifferByLessThanTheRobotResolvesAndNoMore) {
  RunSet set{{"one", "two"}, {square(), square()}};
  set.runs[1].info.parameters["c_R"] += 1e-9;
  EXPECT_EQ(loaded_in_all(set).c_r, 1.01);
  set.runs[1].info.parameters["c_R"] += 1e-4;
  EXPECT_THAT([&] { loaded_in_all(set); },
              ThrowsTelling(AnalysisProblem::runs_of_different_factors, "two", "one"));
}

TEST(Squares, OfRecordingsThatGrowAreCountedAnew) {
  Recordings recordings(RunSet{{"one"}, {square()}});
  EXPECT_EQ(recordings.squares().cw.size(), 1U);
  recordings.add(RunSet{{"two"}, {square()}});
  EXPECT_EQ(recordings.squares().cw.size(), 2U);
}

TEST(Squares, OfOneSizeMayDifferByRoundingAndNoMore) {
  std::vector<recording::Run> runs{square(), square()};
  runs[1].info.size_m += 1e-9;
  EXPECT_EQ(squares_of(runs).cw.size(), 2U);
  runs[1].info.size_m += 1e-3;
  EXPECT_THAT([&] { squares_of(runs); },
              ThrowsTelling(AnalysisProblem::squares_of_different_sizes, "2", "2.001000001"));
}

}  // namespace
}  // namespace astro::experiment
