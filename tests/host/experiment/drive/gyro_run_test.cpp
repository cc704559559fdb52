#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/experiment/drive/record_run.hpp"
#include "host/recording/recording_problem.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/robot/parameters/upload.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/desk.hpp"

// Runs of a robot that uses a gyro.
namespace astro::experiment {
namespace {

using support::Desk;
using support::Tells;
using testing::_;

sim::Config with_gyro() {
  sim::Config config;
  config.gyro.emplace();
  return config;
}

struct GyroRun : testing::Test {
  GyroRun() {
    robot::upload(desk.client, {{"gyro_axis", 3.0}});
    desk.client.pump(std::chrono::seconds(1));  // until the bias is known
    hooks.notice = [this](const Remark& remark) { notices.push_back(remark); };
  }
  recording::Run driven() { return record_run(desk.client, desk.truth, robot::line(1, {0.2, 1}), {}, hooks); }

  /// Of the gyro's heading at the end. Within 6 s its walk of 0.025 degrees per root second and its bias, known to 0.035 degrees per
  /// second, are 0.2 degrees together; three times that is allowed.
  double error_rad(const recording::Run& run) const {
    return run.gyro.back().theta_rad - (desk.robot->board().truth().theta_rad - start_rad);
  }
  static constexpr double kMost_rad = 0.011;

  Desk desk{with_gyro()};
  double start_rad = 0;
  RunHooks hooks;
  std::vector<Remark> notices;
};

TEST_F(GyroRun, HasThePoseWithTheGyroBesideThatOfTheWheels) {
  const recording::Run run = driven();
  ASSERT_FALSE(run.odometry.empty());
  const std::int64_t first_us = run.odometry.front().time_us, last_us = run.odometry.back().time_us;
  std::int64_t before_us = first_us - 1;
  for (const recording::GyroPose& pose : run.gyro) {
    EXPECT_GT(pose.time_us, before_us) << "each once";
    EXPECT_LE(pose.time_us - before_us, 20'000) << "a new one every 10 ms";
    before_us = pose.time_us;
  }
  EXPECT_LE(last_us - before_us, 10'000);
  EXPECT_NEAR(error_rad(run), 0, kMost_rad);
  EXPECT_NEAR(run.gyro.back().x_m, 1, 0.01);
  EXPECT_TRUE(run.slips.empty());
  EXPECT_TRUE(notices.empty());
}

// Three tenths of a second of rest at either end, in which a gyro of 0.025 degrees a second per root hertz is right to 0.0008 rad/s.
TEST(GyroRunOfARobotThatDoesNotKnowItsBias, HasTheSameBiasFromItsStartToItsEnd) {
  sim::Config config = with_gyro();
  config.gyro->bias_radps = 0.02;
  Desk desk{config};
  robot::upload(desk.client, {{"gyro_axis", 3.0}});  // it learns its bias in the second after that
  const recording::Run run = record_run(desk.client, desk.truth, robot::line(0.3, {0.2, 1}), {}, {});
  const std::size_t rest = 30, count = run.gyro.size();
  ASSERT_GT(count, 2 * rest);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < rest; ++i) {
    before += run.gyro[i].omega_radps / static_cast<double>(rest);
    after += run.gyro[count - 1 - i].omega_radps / static_cast<double>(rest);
  }
  EXPECT_NEAR(before, after, 0.003);
  EXPECT_NEAR(before, config.gyro->bias_radps, 0.003);
}

TEST_F(GyroRun, RemembersAndTellsAKickWhichNoWheelHasSeen) {
  constexpr double kKick_rad = 0.2;
  int samples = 0;
  hooks.moved = [&](const recording::OdometrySample&) {
    constexpr int kFirst = 300, kParts = 10;  // 3 s after the start, within 0.1 s
    if (samples++ >= kFirst && samples <= kFirst + kParts) desk.robot->board().kick(kKick_rad / kParts);
  };
  const recording::Run run = driven();
  ASSERT_EQ(run.slips.size(), 1U);
  const double after_s = 1e-6 * static_cast<double>(run.slips[0].time_us - run.odometry.front().time_us);
  EXPECT_NEAR(after_s, 3.1, 0.15) << "the first sample is at 0, and 2 degrees are told within 0.15 s";
  EXPECT_GT(run.slips[0].turn_rad, 0.01) << "0.6 degrees at least";
  EXPECT_LT(run.slips[0].turn_rad, 1.1 * kKick_rad);
  EXPECT_NEAR(error_rad(run), 0, kMost_rad);
  EXPECT_GT(run.gyro.back().theta_rad - run.odometry.back().theta_rad, kKick_rad / 2)
      << "the wheels do not know of it";
  EXPECT_THAT(notices, testing::ElementsAre(Tells(recording::RecordingProblem::turned_unseen, "run", _, _)));
}

}  // namespace
}  // namespace astro::experiment
