#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "host/robot/motion/drive.hpp"
#include "host/robot/motion/drive_problem.hpp"
#include "host/robot/motion/paths.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/desk.hpp"

// A robot whose host falls silent or tells it to stop, in virtual time to the millisecond.
namespace astro {
namespace {

using protocol::Mode;
using std::chrono::milliseconds;

constexpr double kTimeout_s = 0.2;  // command_timeout
constexpr double kRamp_s = 1.0;     // 0.5 m/s at 0.5 m/s^2, acceleration_limit

class LeftAlone : public testing::Test {
 protected:
  protocol::Status status() { return desk.client.request(protocol::GetStatus{}); }

  /// Mean of so many milliseconds.
  double speed_mps(int ms = 1) {
    const sim::Pose a = desk.robot->board().truth();
    for (int i = 0; i < ms; ++i) desk.robot->step();
    const sim::Pose b = desk.robot->board().truth();
    return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) / (0.001 * ms);
  }

  void get_moving() {
    desk.client.request(protocol::Arm{});
    desk.client.request(robot::line(50, {0.5, 0}).front());
    desk.client.pump(std::chrono::seconds(2));
    ASSERT_NEAR(speed_mps(20), 0.5, 0.02);  // in a single millisecond its ripple is 3 % of it (1 sigma)
  }

  /// Steps of a millisecond without the host, until the robot has really stopped; at most 5 s.
  double seconds_to_rest() {
    int ms = 0;
    while (ms < 5000 && speed_mps() > 0.001) ++ms;
    return ms / 1000.0;
  }

  support::Desk desk{support::thesis_robot(support::kThesisSlip_m, 3)};
};

TEST_F(LeftAlone, OnAPathTheRobotStopsItselfWithAFault) {
  get_moving();
  const double seconds = seconds_to_rest();
  EXPECT_NEAR(seconds, kTimeout_s + kRamp_s, 0.15);     // it waits for its time-out, then ramps to rest
  for (int ms = 0; ms < 200; ++ms) desk.robot->step();  // until it has measured that it has stopped
  EXPECT_EQ(status().mode, Mode::fault);
  EXPECT_EQ(status().latched_faults, bit(Fault::link_lost));
}

TEST_F(LeftAlone, WithAVelocityTheRobotStopsItselfAlthoughTheLinkIsAlive) {
  desk.client.request(protocol::Arm{});
  desk.client.request(protocol::Velocity{300'000, 0});
  desk.client.pump(milliseconds(190));  // with pings
  EXPECT_EQ(status().mode, Mode::velocity);
  desk.client.pump(milliseconds(50));
  EXPECT_EQ(status().latched_faults, bit(Fault::command_timeout));
  EXPECT_LT(seconds_to_rest(), kRamp_s);
}

TEST_F(LeftAlone, AnotherHostClearsTheFaultAndDrivesOn) {
  get_moving();
  seconds_to_rest();
  for (int ms = 0; ms < 200; ++ms) desk.robot->step();
  robot::Client second(std::make_unique<simulation::InProcessTransport>(desk.robot));
  second.connect();
  std::vector<Remark> notices;
  robot::DriveHooks hooks;
  hooks.notice = [&](const Remark& notice) { notices.push_back(notice); };
  robot::DriveSession drive(second, hooks);
  drive.run(robot::line(0.5));
  EXPECT_THAT(notices,
              testing::ElementsAre(support::Tells(robot::DriveProblem::faults_left_behind, "link_lost")));
}

TEST_F(LeftAlone, StopRampsToRestAsFastAsTheLimitAllows) {
  get_moving();
  desk.client.request(protocol::Stop{});
  const double start_m = desk.robot->board().truth().x_m;
  int ms = 0;
  while (speed_mps() > 0.001 && ms < 5000) {
    if (++ms % 40 == 0) desk.client.request(protocol::Ping{});  // alive: it is the ramp that stops it
  }
  EXPECT_NEAR(ms / 1000.0, 1.0, 0.15);                                 // 0.5 m/s at 0.5 m/s^2
  EXPECT_NEAR(desk.robot->board().truth().x_m - start_m, 0.25, 0.02);  // v^2 / 2a
  desk.client.pump(milliseconds(200));
  EXPECT_EQ(status().mode, Mode::idle);
}

TEST_F(LeftAlone, EmergencyStopOpensTheBridgesAtOnce) {
  get_moving();
  desk.client.request(protocol::EmergencyStop{});
  protocol::Telemetry newest;
  const auto subscription =
      desk.client.on<protocol::Telemetry>([&](const protocol::Telemetry& telemetry) { newest = telemetry; });
  desk.client.request(protocol::SetTelemetry{1, protocol::Telemetry::kAll});
  desk.client.pump(milliseconds(2));
  EXPECT_EQ(newest.duty.left, 0);
  EXPECT_EQ(newest.duty.right, 0);
  EXPECT_LT(seconds_to_rest(), 1.3);  // it coasts: friction alone takes about a second to end 0.5 m/s
  EXPECT_EQ(status().latched_faults, bit(Fault::emergency_stop));
}

TEST_F(LeftAlone, DisarmedTheRobotTakesNoMotion) {
  for (int i = 0; i < 2; ++i) {
    EXPECT_THROW(desk.client.request(protocol::Velocity{300'000, 0}), robot::RobotRefused);
    EXPECT_THROW(desk.client.request(robot::line(1).front()), robot::RobotRefused);
    desk.client.request(protocol::Arm{});
    desk.client.request(protocol::Disarm{});
  }
  desk.client.pump(milliseconds(500));
  EXPECT_LT(speed_mps(), 1e-6);
}

}  // namespace
}  // namespace astro
