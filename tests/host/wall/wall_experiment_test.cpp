#include "host/wall/wall_experiment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/base/file_problem.hpp"
#include "host/base/folder_lock.hpp"
#include "host/base/interrupted.hpp"
#include "host/robot/parameters/upload.hpp"
#include "host/wall/wall_judgement.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/wall_desk.hpp"

namespace astro::wall {
namespace {

using support::quick_plan;
using support::robot_before_a_wall;
using support::Tells;
using support::TemporaryFolder;
using support::WallDesk;
using testing::HasSubstr;

/// Within five standard errors.
void expect_right(const WallDesk& desk, const WallEstimate& found) {
  EXPECT_LT(std::abs(desk.E_d_error(found)), 5 * found.se.E_d);
  EXPECT_LT(std::abs(desk.b_error(found)), 5 * found.se.b);
  if (found.scale) {
    EXPECT_LT(std::abs(desk.scale_error(found)), 5 * found.se.scale);
  }
}

std::optional<double> confirm(const GapDoubt& doubt) { return doubt.read_m; }

Remark why_not(WallDesk& desk, const WallPlan& plan, const std::filesystem::path& folder,
               const WallHooks& hooks) {
  return support::told_by([&] { run_wall_experiment(desk.desk.client, plan, folder, hooks); });
}

TEST(WallExperiment, FindsTheFactorsOfARobot) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const TemporaryFolder folder;
    WallDesk desk(robot_before_a_wall(seed));
    const WallResult result =
        run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), desk.hooks());
    EXPECT_TRUE(result.reached);
    expect_right(desk, result.estimate);
    EXPECT_EQ(result.estimate.scale->readings, 2);
    EXPECT_LE(desk.board().wall_record().hardest_N, PushLimit{}.force_N);
    EXPECT_LE(desk.board().wall_record().longest_stall_ticks, 1000);
    EXPECT_EQ(desk.desk.client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
  }
}

TEST(WallExperiment, LeavesTheScaleAsItWasIfNobodyReadsARuler) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(4));
  WallHooks hooks = desk.hooks();
  hooks.read_gap = [](double) { return std::nullopt; };
  const WallResult result = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  expect_right(desk, result.estimate);
  EXPECT_FALSE(result.estimate.scale.has_value());
  EXPECT_NEAR(result.estimate.factors.c_r + result.estimate.factors.c_l, 2, 1e-12);
}

TEST(WallExperiment, GoesOnWhereItWasBrokenOff) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(5));
  WallHooks hooks = desk.hooks();
  std::size_t moves = 0;
  for (int broken = 1; broken <= 2; ++broken) {
    const std::uint64_t end_us = desk.board().world_us() + 55'000'000;
    hooks.drive.interrupted = [&] { return desk.board().world_us() > end_us; };
    EXPECT_THROW(run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks), Interrupted);
    EXPECT_EQ(desk.desk.client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
    const auto journal = read_wall_journal(folder.path());
    ASSERT_TRUE(journal.has_value());
    EXPECT_GT(journal->moves.size(), moves) << "nothing that was driven is lost";
    moves = journal->moves.size();
  }
  hooks.drive.interrupted = [] { return false; };
  const WallResult result = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  expect_right(desk, result.estimate);
  EXPECT_EQ(result.journal.drive.size(), 3U);
  const WallResult again = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  EXPECT_EQ(again.journal.moves.size(), result.journal.moves.size()) << "a finished one drives no more";
  EXPECT_EQ(again.estimate.factors.b_m, result.estimate.factors.b_m);
}

TEST(WallExperiment, DoesNotCountAWayOnWhichTheRobotWasTurned) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(6));
  WallHooks hooks = desk.hooks();
  std::vector<Remark> notices;
  hooks.drive.notice = [&](const Remark& remark) { notices.push_back(remark); };
  bool turned = false;
  hooks.read_gap = [&](double) {
    // Somebody stumbles over the robot while the ruler is read.
    sim::Pose pose = desk.board().truth();
    pose.theta_rad += turned ? 0 : 0.3;
    turned = true;
    desk.board().place(pose);
    return std::optional(desk.read_gap_m());
  };
  hooks.read_again = confirm;
  const WallResult result = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  ASSERT_FALSE(notices.empty());
  EXPECT_THAT(notices.front(), Tells(SquaringDoubt::Kind::turned));
  EXPECT_LT(std::abs(desk.E_d_error(result.estimate)), 5 * result.estimate.se.E_d);
  EXPECT_LT(std::abs(desk.b_error(result.estimate)), 5 * result.estimate.se.b);
  ASSERT_TRUE(result.estimate.scale);
  EXPECT_EQ(result.estimate.scale->readings,
            quick_plan().readings);  // what was read beside a turned robot is forgotten
}

TEST(WallExperiment, GivesUpIfTheWallIsNeverWhereItWas) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(7));
  WallHooks hooks = desk.hooks();
  hooks.read_gap = [&](double) {
    sim::Pose pose = desk.board().truth();
    pose.x_m -= 0.08;
    desk.board().place(pose);
    return std::nullopt;
  };
  EXPECT_THAT(why_not(desk, quick_plan(), folder.path(), hooks),
              testing::AnyOf(Tells(SquaringDoubt::Kind::too_late), Tells(WallProblem::no_wall)));
}

TEST(WallExperiment, AsksAgainAboutAGapThatCannotBe) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(8));
  WallHooks hooks = desk.hooks();
  std::vector<GapDoubt::Mistake> doubts;
  hooks.read_gap = [&](double expected_m) {
    EXPECT_NEAR(expected_m, quick_plan().gap_m, 0.03);
    return std::optional(desk.read_gap_m() * 0.1);
  };
  hooks.read_again = [&](const GapDoubt& doubt) {
    doubts.push_back(doubt.mistake);
    return std::optional(desk.read_gap_m());
  };
  const WallResult result = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  EXPECT_THAT(doubts, testing::Each(GapDoubt::Mistake::other_unit));
  EXPECT_EQ(doubts.size(), 2U);
  expect_right(desk, result.estimate);
}

TEST(WallExperiment, NeverDrivesFurtherForAGapThatWasMisreadAndConfirmed) {
  // All but a fifth, which is the most that is held for possible.
  for (const double times : {0.82, 0.9, 1.1, 1.18}) {
    const TemporaryFolder folder;
    WallDesk desk(robot_before_a_wall(13));
    WallHooks hooks = desk.hooks();
    double furthest_m = 0;
    hooks.read_gap = [&](double) { return std::optional(desk.read_gap_m() * times); };
    hooks.read_again = confirm;
    hooks.drive.interrupted = [&] {
      furthest_m = std::max(furthest_m, desk.board().wall()->front_gap_m(desk.board().truth()));
      return false;
    };
    const WallResult result = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
    EXPECT_NEAR((result.estimate.factors.c_r + result.estimate.factors.c_l) / 2, desk.config.scale * times,
                0.01);
    // The line, twice the room to turn in, and 5 % of both, and the wheels' own scale.
    const double room_m =
        1.05 * 1.02 * (quick_plan().line_m + 2 * (BodySize{}.turning_gap_m() + BodySize{}.length_m / 2));
    EXPECT_LT(furthest_m, room_m) << times;
  }
}

TEST(WallExperiment, TakesNoGapThatCannotBeHoweverOftenItIsConfirmed) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(14));
  WallHooks hooks = desk.hooks();
  int confirmed = 0;
  hooks.read_gap = [&](double) { return std::optional(desk.read_gap_m() / 10); };
  hooks.read_again = [&](const GapDoubt& doubt) {
    EXPECT_FALSE(doubt.possible);
    return std::optional(++confirmed % 3 == 0 ? desk.read_gap_m() : doubt.read_m);
  };
  expect_right(desk, run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks).estimate);
  EXPECT_EQ(confirmed, 6);
}

TEST(WallExperiment, AsksForAnotherReadingIfTwoContradictEachOtherAndLeavesTheWrongOneOut) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(15));
  WallHooks hooks = desk.hooks();
  int asked = 0;
  std::vector<Remark> notices;
  hooks.drive.notice = [&](const Remark& remark) { notices.push_back(remark); };
  hooks.read_gap = [&](double) { return std::optional(desk.read_gap_m() + (asked++ == 0 ? 0.025 : 0)); };
  hooks.read_again = confirm;
  const WallResult result = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  EXPECT_EQ(asked, 3);
  EXPECT_THAT(notices, testing::ElementsAre(Tells(WallProblem::readings_contradict)));
  EXPECT_EQ(result.estimate.scale->readings, 2);
  EXPECT_EQ(result.estimate.scale->left_out, 1);
  expect_right(desk, result.estimate);
}

TEST(WallExperiment, HasALargeErrorOfTheScaleIfNoReadingsAgree) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(16));
  WallHooks hooks = desk.hooks();
  int asked = 0;
  hooks.read_gap = [&](double) { return std::optional(desk.read_gap_m() + 0.03 * asked++); };
  hooks.read_again = confirm;
  const WallResult result = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  EXPECT_EQ(asked, 4) << "two more, and no further";
  EXPECT_TRUE(result.estimate.scale->contradictory());
  EXPECT_GT(result.estimate.se.scale, 0.01) << "they differ by 3 cm on a metre, four of them";
  const auto judgement = judge_wall(result.journal.drive, result.estimate, result.journal.loaded);
  EXPECT_NE(judgement.verdict, calibration::Verdict::better);
  EXPECT_THAT(judgement.sentence(), HasSubstr("contradict each other"));
}

TEST(WallExperiment, LetsOnlyOneProgramDriveInAFolder) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(17));
  const FolderLock other(folder.path());
  EXPECT_THAT(why_not(desk, quick_plan(), folder.path(), desk.hooks()),
              support::Tells(FileProblem::folder_in_use, folder.path().string()));
  EXPECT_EQ(desk.board().truth().x_m, 0) << "nothing has moved";
}

TEST(WallExperiment, RefusesAJournalThatNoProgramWrote) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(18));
  WallHooks hooks = desk.hooks();
  hooks.drive.interrupted = [&] { return desk.board().world_us() > 100'000'000; };
  EXPECT_THROW(run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks), Interrupted);
  std::ifstream file(folder.path() / "wall.json");
  const nlohmann::json good = nlohmann::json::parse(file);
  ASSERT_FALSE(good.at("series").at(0).at("readings").empty());
  const std::vector<std::pair<std::string, nlohmann::json>> wrong{
      {"/series/0/squarings", nlohmann::json::array()},
      {"/series/0/squarings/1", good.at("series").at(0).at("squarings").at(0)},
      {"/series/0/squarings/1/0", 1e300},
      {"/series/0/squarings/1/2", -1},
      {"/series/0/squarings/1", {1, 2, 3}},
      {"/series/0/readings/0/gap_m", 0},
      {"/series/0/readings/0/gap_m", 1e9},
      {"/series/0/readings/0/squaring", -1},
      {"/series/0/readings/0/squaring", 1.5},
      {"/series/0/readings/0/travel/2", 0},
      {"/loaded/c_R", 40},
      {"/loaded/b_m", 0},
      {"/count_m", 0},
      {"/moves/0/kind", 9},
      {"/moves/0/turns", 1000000000},
      {"/moves/0/away_m", 1e9},
      {"/moves", nlohmann::json::array()},
      {"/driven_s", -1},
      {"/driven_s", 1e9},
      {"/driven_s", nullptr},
      {"/plan/readings", 2.5},
      {"/plan/line_m", 0}};
  for (const auto& [where, value] : wrong) {
    nlohmann::json bad = good;
    bad.at(nlohmann::json::json_pointer(where)) = value;
    std::ofstream(folder.path() / "wall.json") << bad;
    EXPECT_THAT(why_not(desk, quick_plan(), folder.path(), desk.hooks()), Tells(WallProblem::journal_damaged))
        << where << " = " << value;
  }
  std::ofstream(folder.path() / "wall.json") << good;
  EXPECT_TRUE(read_wall_journal(folder.path()).has_value()) << "as it was written it is good";
}

TEST(WallExperiment, FindsTheSameFactorsOnARobotThatCarriesOthers) {
  const TemporaryFolder folder;
  sim::Config config = robot_before_a_wall(9);
  WallDesk desk(config);
  robot::upload(desk.desk.client, {{"c_R", 1.004}, {"c_L", 0.99}, {"b", 0.2875}});
  const WallResult result = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), desk.hooks());
  EXPECT_NEAR(result.journal.loaded.b_m, 0.2875, 1e-9);
  expect_right(desk, result.estimate);
}

TEST(WallExperiment, RefusesAFolderOfOtherSettingsOrAnotherRobotOrADamagedOne) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(10)), other(robot_before_a_wall(11));
  WallHooks hooks = desk.hooks();
  hooks.drive.interrupted = [&] { return desk.board().world_us() > 30'000'000; };
  EXPECT_THROW(run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks), Interrupted);
  WallPlan longer = quick_plan();
  longer.line_m = 2.5;
  EXPECT_THAT(why_not(desk, longer, folder.path(), hooks), Tells(WallProblem::other_settings));
  EXPECT_THAT(why_not(other, quick_plan(), folder.path(), other.hooks()), Tells(WallProblem::other_robot));
  std::ofstream(folder.path() / "wall.json") << "{\"format\": 1";
  EXPECT_THAT(why_not(desk, quick_plan(), folder.path(), hooks), Tells(WallProblem::journal_damaged));
}

TEST(WallExperiment, RefusesWhatCannotBeDriven) {
  const TemporaryFolder folder;
  WallDesk desk(robot_before_a_wall(12));
  using testing::Matcher;
  const std::vector<std::pair<std::function<void(WallPlan&)>, Matcher<const Remark&>>> wrong{
      {[](WallPlan& plan) { plan.line_m = 0.1; }, Tells(WallProblem::impossible_plan, "line_m", "0.1")},
      {[](WallPlan& plan) { plan.gap_m = 100; }, Tells(WallProblem::impossible_plan, "gap_m", "100")},
      {[](WallPlan& plan) { plan.readings = -1; }, Tells(WallProblem::impossible_plan, "readings", "-1")},
      {[](WallPlan& plan) { plan.push.force_N = 1; }, Tells(WallProblem::push_too_weak, "1")},
      {[](WallPlan& plan) { plan.push.force_N = 80; }, Tells(WallProblem::push_too_strong, "80")},
      {[](WallPlan& plan) { plan.squaring_rad = 0.1; },
       Tells(WallProblem::impossible_plan, "squaring_rad", "0.1")},
      {[](WallPlan& plan) { plan.targets.E_d = 0; }, Tells(WallProblem::impossible_plan, "E_d", "0")},
      {[](WallPlan& plan) { plan.body.width_m = 0; }, Tells(WallProblem::impossible_plan, "body")},
      {[](WallPlan& plan) { plan.most_minutes = NAN; },
       Tells(WallProblem::impossible_plan, "most_minutes", "nan")}};
  for (const auto& [spoil, tells] : wrong) {
    WallPlan plan = quick_plan();
    spoil(plan);
    EXPECT_THAT(why_not(desk, plan, folder.path(), desk.hooks()), tells);
  }
  EXPECT_EQ(desk.board().truth().x_m, 0) << "nothing has moved";
}

}  // namespace
}  // namespace astro::wall
