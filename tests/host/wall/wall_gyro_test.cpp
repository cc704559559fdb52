#include "host/wall/wall_gyro.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "host/base/interrupted.hpp"
#include "host/base/text/degrees.hpp"
#include "host/robot/parameters/upload.hpp"
#include "host/wall/wall_calibration.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/support/robots/wall_desk.hpp"

// The gyro of simulated robots that are calibrated in front of a wall.
namespace astro::wall {
namespace {

using support::quick_plan;
using support::Tells;
using support::TemporaryFolder;
using support::WallDesk;

/// A robot whose gyro is up to 2 % off, and whose front lies against the wall anew each time, with an error of `play_rad`.
sim::Config robot_with_gyro(std::uint64_t seed, double play_rad = 0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  sim::Config config = support::robot_before_a_wall(seed);
  config.body.front_play_rad = play_rad;
  config.gyro = sim::GyroConfig{.bias_radps = 0.02 * normal(random), .scale = 1 + 0.01 * normal(random)};
  return config;
}

struct GyroDesk : WallDesk {
  explicit GyroDesk(const sim::Config& robot, double axis = 3) : WallDesk(robot) {
    robot::upload(desk.client, {{"gyro_axis", axis}});
    desk.client.pump(std::chrono::seconds(1));  // it stands, and learns its bias
  }
  double scale() const { return config.gyro->scale; }
};

TEST(WallGyro, FindsTheScaleOfAGyroByWholeTurns) {
  const TemporaryFolder folder;
  GyroDesk desk(robot_with_gyro(31));
  const WallResult found = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), desk.hooks());
  ASSERT_TRUE(found.gyro);
  EXPECT_EQ(found.gyro->by, experiment::GyroReference::wall);
  EXPECT_NEAR(found.gyro->scale.scale, desk.scale(), 4 * found.gyro->scale.se);
  EXPECT_LT(found.gyro->scale.se, 1e-3);
  EXPECT_THAT(experiment::gyro_sentence(*found.gyro), testing::HasSubstr("against the wall"));
  const nlohmann::json json =
      to_json(found, judge_wall(found.journal.drive, found.estimate, found.journal.loaded));
  EXPECT_EQ(json.at("gyro").at("scale_by"), "wall");
  EXPECT_EQ(json.at("gyro").at("biases").size(), 1U);
  EXPECT_EQ(json.at("gyro").at("scale").get<double>(), found.gyro->scale.scale);
}

TEST(WallGyro, DoesNotDependOnTheWheelbaseThatTheRobotCarries) {
  const TemporaryFolder folder;
  GyroDesk desk(robot_with_gyro(32));
  robot::upload(desk.desk.client, {{"b", 0.283}});  // 2 % less, so that it takes each turn for a slip
  std::vector<Remark> notices;
  WallHooks hooks = desk.hooks();
  hooks.drive.notice = [&](const Remark& remark) { notices.push_back(remark); };
  const WallResult found = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  ASSERT_TRUE(found.gyro);
  EXPECT_NEAR(found.gyro->scale.scale, desk.scale(), 4 * found.gyro->scale.se);
  EXPECT_THAT(notices, testing::IsEmpty());
}

TEST(WallGyro, GoesOnWithWhatWasRecordedBefore) {
  const TemporaryFolder folder;
  GyroDesk desk(robot_with_gyro(33));
  WallHooks hooks = desk.hooks();
  const std::uint64_t end_us = desk.board().world_us() + 90'000'000;
  hooks.drive.interrupted = [&] { return desk.board().world_us() > end_us; };
  EXPECT_THROW(run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks), Interrupted);
  hooks.drive.interrupted = [] { return false; };
  const WallResult found = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  ASSERT_TRUE(found.gyro);
  EXPECT_EQ(found.gyro->names.size(), 2U) << "a series before and one after";
  EXPECT_NEAR(found.gyro->scale.scale, desk.scale(), 4 * found.gyro->scale.se);
  const WallResult again = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  ASSERT_TRUE(again.gyro);
  // Files hold what the robot measured, so only times and headings that were written round.
  EXPECT_NEAR(again.gyro->scale.scale, found.gyro->scale.scale, 1e-9);
}

TEST(WallGyro, AsksForATurnAgainInWhichTheRobotWasKicked) {
  const TemporaryFolder folder;
  GyroDesk desk(robot_with_gyro(34));
  WallHooks hooks = desk.hooks();
  std::vector<Remark> notices;
  hooks.drive.notice = [&](const Remark& remark) { notices.push_back(remark); };
  std::uint64_t kick_us = 0;
  hooks.move_started = [&](const WallMove& move, int, int) {
    if (move.kind == WallMove::Kind::laps && std::abs(move.turns) == 2 && kick_us == 0)
      kick_us = desk.board().world_us() + 15'000'000;
  };
  int kicks = 0;
  hooks.drive.interrupted = [&] {
    // A push over a fifth of a second, by less than the wheels may slip on two laps, so that the wall alone would not tell.
    if (kick_us == 0 || desk.board().world_us() < kick_us + 10'000U * static_cast<unsigned>(kicks) ||
        kicks == 20)
      return false;
    ++kicks;
    desk.board().kick(radians(3.0) / 20);
    return false;
  };
  const WallResult found = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  ASSERT_EQ(kicks, 20);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_THAT(notices.front(), Tells(WallProblem::slipped));
  EXPECT_THAT(notices.front().sentence, testing::HasSubstr("driven again"));
  EXPECT_EQ(found.journal.drive.size(), 2U) << "what was driven since the kick is a series of its own";
  ASSERT_TRUE(found.gyro);
  EXPECT_NEAR(found.gyro->scale.scale, desk.scale(), 4 * found.gyro->scale.se);
  EXPECT_LT(std::abs(desk.b_error(found.estimate)), 5 * found.estimate.se.b);
}

TEST(WallGyro, TellsOfAGyroThatDoesNotTurnWithTheRobotAndCalibratesTheWheels) {
  const TemporaryFolder folder;
  GyroDesk desk(robot_with_gyro(35), 1);
  WallHooks hooks = desk.hooks();
  std::vector<Remark> notices;
  hooks.drive.notice = [&](const Remark& remark) { notices.push_back(remark); };
  const WallResult found = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  EXPECT_FALSE(found.gyro);
  EXPECT_THAT(notices, testing::ElementsAre(Tells(calibration::GyroProblem::nothing_alike)));
  EXPECT_LT(std::abs(desk.b_error(found.estimate)), 5 * found.estimate.se.b);
}

TEST(WallGyro, TellsOfAGyroThatIsNotThere) {
  const TemporaryFolder folder;
  WallDesk desk(support::robot_before_a_wall(37));
  robot::upload(desk.desk.client, {{"gyro_axis", 3.0}});
  WallHooks hooks = desk.hooks();
  std::vector<Remark> notices;
  hooks.drive.notice = [&](const Remark& remark) { notices.push_back(remark); };
  const WallResult found = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), hooks);
  EXPECT_FALSE(found.gyro);
  EXPECT_THAT(notices, testing::ElementsAre(Tells(calibration::GyroProblem::no_rates)));
}

TEST(WallGyro, RecordsNothingOfARobotWithoutOne) {
  const TemporaryFolder folder;
  WallDesk desk(support::robot_before_a_wall(36));
  const WallResult found = run_wall_experiment(desk.desk.client, quick_plan(), folder.path(), desk.hooks());
  EXPECT_FALSE(found.gyro);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "moves"));
}

/// Relative errors, and over the errors that were stated.
struct RelativeErrors {
  double squares = 0, normalised = 0;
  int count = 0;

  void add(double error, double se) {
    squares += error * error;
    normalised += error * error / (se * se);
    ++count;
  }
  double rms() const { return std::sqrt(squares / count); }
  double chi_square() const { return normalised / count; }
};

// One robot each time shows that nothing is grossly off; forty show the figures. Chi-square of forty scatters by 0.22.
TEST(FortyGyros, AreCalibratedToATenthOfAPercentWithoutATracker) {
  const int robots = support::how_often(1, 40);
  for (const double alignment_deg : {0.5, 1.0}) {
    RelativeErrors b, scale;
    int slips = 0;
    double minutes = 0;
    for (int seed = 1; seed <= robots; ++seed) {
      const TemporaryFolder folder;
      GyroDesk desk(robot_with_gyro(static_cast<std::uint64_t>(seed) + 100, radians(alignment_deg)));
      WallPlan plan;
      plan.squaring_rad = radians(alignment_deg);
      plan.most_minutes = 15;
      WallHooks hooks = desk.hooks();
      hooks.drive.notice = [&](const Remark&) { ++slips; };
      const WallResult found = run_wall_experiment(desk.desk.client, plan, folder.path(), hooks);
      ASSERT_TRUE(found.gyro) << seed;
      b.add(desk.b_error(found.estimate), found.estimate.se.b);
      scale.add(found.gyro->scale.scale / desk.scale() - 1, found.gyro->scale.se / desk.scale());
      minutes = std::max(minutes, found.journal.driven_s / 60);
    }
    fmt::print(
        "{} robots, {} degrees: rms error and chi-square: b {:.4f} % {:.2f}, gyro's scale {:.4f} % {:.2f}; "
        "{} moves again, {:.1f} min\n",
        robots, alignment_deg, 100 * b.rms(), b.chi_square(), 100 * scale.rms(), scale.chi_square(), slips,
        minutes);
    if (!support::thorough()) {
      EXPECT_LT(b.rms(), 3e-3) << "one robot is no statistics";
      EXPECT_LT(scale.rms(), 3e-3);
      continue;
    }
    EXPECT_LT(b.rms(), 1e-3);
    EXPECT_LT(scale.rms(), 1e-3);
    // Some ten squarings hardly show how exact each is (host/wall/README.md): the errors are stated too small, those of b by a fifth,
    // those of the gyro's scale by two fifths. Chi-square would be 1.5 and 2, and scatters by a fifth.
    EXPECT_GT(b.chi_square(), 0.6);
    EXPECT_LT(b.chi_square(), 2.0);
    EXPECT_GT(scale.chi_square(), 0.6);
    EXPECT_LT(scale.chi_square(), 2.6);
  }
}

}  // namespace
}  // namespace astro::wall
