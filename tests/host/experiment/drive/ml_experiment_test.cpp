#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/calibration/preparation/preparation_problem.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/until.hpp"
#include "host/experiment/drive/experiment.hpp"
#include "host/experiment/files/experiment_folder.hpp"
#include "host/experiment/files/method_names.hpp"
#include "host/recording/run_file.hpp"
#include "host/robot/parameters/upload.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/links/fake_link.hpp"
#include "tests/support/robots/desk.hpp"

// Experiments with maximum likelihood, the default where cameras follow the robot.
namespace astro::experiment {
namespace {

namespace fs = std::filesystem;
using support::Desk;
using support::kThesisSlip_m;
using support::Tells;
using support::TemporaryFolder;
using support::thesis_robot;
using support::ThrowsTelling;
using testing::_;
using testing::Contains;
using testing::StartsWith;

Plan small_plan(int runs, int rounds = 1) {
  Plan plan;
  plan.runs = runs;
  plan.rounds = rounds;
  plan.side_m = 1.5;
  plan.extras = false;
  plan.truth = "sim";
  return plan;
}

class MlExperiment : public testing::Test {
 protected:
  MlExperiment() : config_(scaled_robot()), desk_(config_) {
    hooks_.run.notice = [this](const Remark& remark) { notices_.push_back(remark); };
    hooks_.run_started = [this](const RunSpec& spec, int, int) { driven_.push_back(spec.title()); };
  }

  /// Also its mean wheel is not what it believes: what end poses of squares cannot see.
  static sim::Config scaled_robot() {
    sim::Config config = thesis_robot(kThesisSlip_m, 1);
    config.scale = 1.003;
    return config;
  }
  Results run(const Plan& plan) {
    driven_.clear();
    notices_.clear();
    return run_experiment(desk_.client, desk_.truth, plan, folder_.path(), hooks_);
  }
  std::int64_t driven_in(const std::string& phase) const {
    return std::count_if(driven_.begin(), driven_.end(),
                         [&](const std::string& title) { return title.starts_with(phase + ":"); });
  }

  sim::Config config_;
  Desk desk_;
  TemporaryFolder folder_;
  ExperimentHooks hooks_;
  std::vector<std::string> driven_;
  std::vector<Remark> notices_;
};

/// Both sides exchanged, so that the loops of the wheels work and the robot drives in mirror image.
class ExchangedSides : public MlExperiment {
 protected:
  ExchangedSides() : other_(exchanged()) {}
  static sim::Config exchanged() {
    sim::Config config = scaled_robot();
    config.wiring.motors_swapped = config.wiring.encoders_swapped = true;
    return config;
  }
  Desk other_;
};

TEST_F(ExchangedSides, EndTheExperimentAtTheFirstDriveAlsoIfItIsResumed) {
  for (int time = 0; time < 2; ++time) {
    driven_.clear();
    const Remark told = support::told_by(
        [&] { run_experiment(other_.client, other_.truth, small_plan(2), folder_.path(), hooks_); });
    EXPECT_EQ(told.kind, Kind(calibration::PreparationProblem::mirrored)) << told.sentence;
    EXPECT_EQ(driven_.size(), time == 0 ? 1U : 0U);
  }
}

/// The firmware of a FakeRobot is one that knows c_R, c_L and b.
TEST_F(MlExperiment, IsRefusedBeforeTheFirstDriveOfAFirmwareThatKnowsNoE) {
  test::FakeLink link;
  robot::Client client(link);
  client.connect();
  const auto told = [&](const Plan& plan) {
    return support::told_by([&] {
      run_experiment(client, desk_.truth, plan, folder_.path() / std::string(name_of(plan.method)), hooks_);
    });
  };
  Plan plan = small_plan(1);
  EXPECT_EQ(told(plan).kind, Kind(UploadProblem::e_needed));
  EXPECT_THAT(driven_, testing::IsEmpty());
  plan.method = method_named("robust", "average", "exact");
  EXPECT_NE(told(plan).kind, Kind(UploadProblem::e_needed)) << "end poses find no e";
  EXPECT_EQ(driven_.size(), 1U);
}

TEST_F(MlExperiment, IsWhatHappensWhereCamerasFollowTheRobot) {
  const Results results = run(small_plan(2));
  const Calibration& found = *results.before().calibration;
  EXPECT_EQ(found.method(), "ml");
  ASSERT_NE(found.ml(), nullptr);
  EXPECT_TRUE(found.ml()->options.clock_known) << "the simulator's cameras have the robot's clock";
  EXPECT_EQ(found.ml()->estimate.runs.size(), 4U);
  ASSERT_TRUE(found.squares.has_value());
  EXPECT_EQ(found.squares->E_max_syst_m, results.before().summary.E_max_syst_m);
}

TEST_F(MlExperiment, FindsRatioWheelbaseAndScaleWithinItsErrors) {
  const Calibration found = *run(small_plan(3)).before().calibration;
  fmt::print("seed 1: E_d {:.6f} ± {:.6f}, E_b {:.6f} ± {:.6f}, S {:.6f} ± {:.6f}\n", found.E_d(),
             found.se.E_d, found.E_b(), found.se.E_b, found.scale(), found.se.scale);
  // Four standard errors: one such test in 5000 fails by chance, and the seed is fixed.
  EXPECT_NEAR(found.E_d(), config_.true_ed, 4 * found.se.E_d);
  EXPECT_NEAR(found.factors.b_m, config_.true_wheelbase_m, 4 * found.se.b_m);
  EXPECT_NEAR(found.scale(), config_.scale, 4 * found.se.scale);
  EXPECT_LT(found.se.E_d, 2e-3);
  EXPECT_LT(found.se.scale, 1e-3);
}

TEST_F(MlExperiment, ASecondRoundAddsToTheFirstAndChangesLittle) {
  const Results results = run(small_plan(3, 2));
  ASSERT_EQ(results.phases.size(), 3U);
  const Calibration &first = *results.phases[0].calibration, &second = *results.phases[1].calibration;
  // The second round drives with what the first found...
  EXPECT_NEAR(results.phases[1].squares().loaded.b_m, first.factors.b_m, 1e-8);
  EXPECT_NEAR(second.loaded.c_r, first.factors.c_r, 1e-8);
  // ... and its runs are added to those of the first. What they change is as uncertain as the first was.
  EXPECT_EQ(second.ml()->estimate.runs.size(), 12U);
  EXPECT_NEAR(second.factors.c_r, first.factors.c_r, 4 * first.se.c_r);
  EXPECT_NEAR(second.factors.c_l, first.factors.c_l, 4 * first.se.c_l);
  EXPECT_NEAR(second.factors.b_m, first.factors.b_m, 4 * first.se.b_m);
  EXPECT_NEAR(second.factors.b_m, config_.true_wheelbase_m, 4 * second.se.b_m);
  // Twice the data: 0.71 of the error, as far as the noise is estimated alike.
  EXPECT_LT(second.se.b_m, 0.8 * first.se.b_m);
  ASSERT_TRUE(second.squares.has_value());
  EXPECT_EQ(second.squares->E_max_syst_m, results.phases[1].summary.E_max_syst_m);
  // The first moves the ratio by 0.4 %, the second within what both do not know: some 0.05 %.
  EXPECT_GT(std::abs(first.E_d() - 1), 4 * std::abs(second.E_d() - 1));
}

TEST_F(MlExperiment, RunsWithDifferentFactorsInForceAreCalibratedTogether) {
  run(small_plan(2));
  const RunSet all = read_run_set(folder_.path());
  const Calibration together = calibrate(all, {});
  EXPECT_EQ(together.ml()->estimate.runs.size(), 8U);
  EXPECT_NEAR(together.factors.b_m, config_.true_wheelbase_m, 4 * together.se.b_m);
  EXPECT_NEAR(together.factors.c_r / together.factors.c_l, config_.true_ed,
              4 * together.ml()->estimate.se.E_d);
  EXPECT_FALSE(together.squares.has_value()) << "squares of two sets of factors have no common error";
  EXPECT_THAT([&] { calibrate(all, method_named("extended", "average", "exact")); },
              ThrowsTelling(AnalysisProblem::squares_of_different_factors));
}

TEST_F(MlExperiment, TakesGivenNoiseAndAnUnknownClock) {
  run(small_plan(2));
  const RunSet set = read_run_set(folder_.path() / "before");
  MlChoice choice;
  choice.noise = calibration::NoiseModel{1e-6, 3e-4, 2e-3};
  choice.clock = MlChoice::Clock::estimated;
  const Calibration found = calibrate(set, {}, choice);
  EXPECT_EQ(found.ml()->estimate.noise.K_m, 1e-6);
  EXPECT_FALSE(found.ml()->options.clock_known);
  const nlohmann::json json = to_json(found);
  EXPECT_EQ(json["noise"]["given"], true);
  EXPECT_EQ(json["clock_known"], false);
  // The simulated cameras stamp with the robot's clock, to its tick of 1 ms and a tick of latency.
  for (const auto& run : json["runs"]) EXPECT_NEAR(run["clock_offset_s"].get<double>(), 0, 2e-3);
}

TEST_F(MlExperiment, FallsBackToEndPosesWhereOneRunWasOnlyMeasuredAtItsEnds) {
  run(small_plan(2));
  RunSet set = read_run_set(folder_.path() / "before");
  set.runs.front().info.truth_source = "manual";
  EXPECT_EQ(calibrate(set, {}).method(), "robust");
  EXPECT_THAT([&] { calibrate(set, method_named("ml", "average", "exact")); },
              ThrowsTelling(AnalysisProblem::run_without_truth, set.names.front()));
}

Plan until_plan(double target, int most) {
  Plan plan = small_plan(1);
  plan.until = Until{target, most};
  return plan;
}

TEST_F(MlExperiment, DrivesUntilThePrecisionIsReachedAndNoFurther) {
  // By the design rule b is known to sqrt(K / (b Theta)) = 0.060 % after 2 + 2 squares; 0.04 % needs 9.
  constexpr double kTarget = 4e-4;
  const Results results = run(until_plan(kTarget, 20));
  const Calibration& found = *results.before().calibration;
  for (const Remark& notice : notices_) fmt::print("{}\n", notice.sentence);
  EXPECT_TRUE(reaches(precision_of(found), kTarget));
  const std::int64_t squares = driven_in("before") / 2;
  EXPECT_GT(squares, kFewestPairs);
  EXPECT_LT(squares, 10);
  EXPECT_EQ(driven_in("after"), 2) << "the squares after are as many as planned";
  const RunSet fewer =
      read_specs(folder_.path(), squares_of_phase(until_plan(kTarget, 20), 0, static_cast<int>(squares) - 1));
  EXPECT_FALSE(reaches(precision_of(calibrate(fewer, {})), kTarget)) << "one pair less was not enough";
}

TEST_F(MlExperiment, ReadsEachRecordingOnceHoweverManyPairsFollow) {
  hooks_.run.notice = [this](const Remark& remark) {
    notices_.push_back(remark);
    if (!testing::Matches(Tells(PrecisionNotice::reached_by_now, "before", "2", _))(remark)) return;
    // They were read for this figure. Whoever reads them again finds no recording.
    for (const char* name :
         {"square-cw-1.mcap", "square-ccw-1.mcap", "square-cw-2.mcap", "square-ccw-2.mcap"})
      std::ofstream(folder_.path() / "before" / name) << "no recording";
  };
  const Results results = run(until_plan(1e-5, 3));
  EXPECT_THAT(notices_,
              Contains(Tells(PrecisionNotice::reached_by_now, "before", "3", StartsWith("E_d ± "))));
  EXPECT_EQ(results.before().calibration->ml()->estimate.runs.size(), 6U);
}

TEST_F(MlExperiment, ReadsAgainIfARecordingWasTakenAwayToBeDrivenAgain) {
  hooks_.run.notice = [this](const Remark& remark) {
    if (testing::Matches(Tells(PrecisionNotice::reached_by_now, "before", "2", _))(remark))
      fs::remove(folder_.path() / "before" / "square-cw-1.mcap");
  };
  const Results results = run(until_plan(1e-5, 3));
  EXPECT_EQ(driven_in("before"), 7);
  const std::vector<recording::Run>& runs = results.before().runs();
  ASSERT_EQ(runs.size(), 6U);
  const recording::Run kept = recording::read_run(folder_.path() / "before" / "square-cw-1.mcap");
  EXPECT_EQ(runs.front().odometry.front().time_us, kept.odometry.front().time_us);
}

TEST_F(MlExperiment, SaysWhatWasReachedWhenTheMostSquaresAreDriven) {
  const Results results = run(until_plan(1e-5, 3));
  EXPECT_EQ(driven_in("before"), 6);
  EXPECT_THAT(notices_,
              Contains(Tells(PrecisionNotice::reached_by_now, "before", "3", StartsWith("E_d ± "))));
  EXPECT_THAT(notices_, Contains(Tells(PrecisionNotice::most_squares, "before", "3", "0.001")));
  EXPECT_EQ(results.phases.size(), 2U);
}

TEST_F(MlExperiment, GoesOnWithTheSquaresThatAreRecorded) {
  const Plan plan = until_plan(1e-5, 4);
  hooks_.run.interrupted = [this] { return driven_.size() >= 6; };  // in the second of the third pair
  EXPECT_THROW(run(plan), Interrupted);
  EXPECT_EQ(recorded_squares(folder_.path(), plan, 0), 2);
  hooks_.run.interrupted = [] { return false; };
  run(plan);
  EXPECT_EQ(driven_.front(), "before: square ccw 3");
  EXPECT_EQ(driven_in("before"), 3);
  EXPECT_EQ(driven_in("after"), 2);
  run(plan);
  EXPECT_TRUE(driven_.empty()) << "a finished experiment drives nothing";
}

}  // namespace
}  // namespace astro::experiment
