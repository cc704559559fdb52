#include <cmath>
#include <fstream>
#include <numbers>

#include "tests/host/programs/ros2/robot_among_peers.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/support/links/pty_cable.hpp"
#include "tests/support/ros2/two_computers.hpp"

namespace astro {
namespace {

using support::eventually;
using support::number_in;
using support::PeerKind;
using support::PeerProgram;
using testing::AllOf;
using testing::HasSubstr;

class Ros2 : public support::RobotAmongPeers {
 protected:
  Ros2() { start_robot(); }

  void set_no_timeout() const {
    const auto set = support::astrolabe({"params", "set", "command_timeout=0", "--yes", "--port", port()});
    ASSERT_EQ(set.code, 0) << set.err;
  }

  struct Pose {
    double x_m = 0, y_m = 0, heading_rad = 0;
  };
  static Pose pose(PeerProgram& peer) {
    const std::string line = next(peer, "/odom");
    return {number_in(line, "x"), number_in(line, "y"), number_in(line, "heading")};
  }
  static void command(PeerProgram& peer, const std::string& kind, double v_mps, double omega_radps) {
    ask(peer, kind + " /cmd_vel " + std::to_string(v_mps) + ' ' + std::to_string(omega_radps),
        "sent /cmd_vel");
  }
  static void expect_to_see_the_robot(PeerProgram& peer) {
    for (const auto& [topic, type] :
         {std::pair("/odom", "odometry"), std::pair("/tf", "transforms"),
          std::pair("/joint_states", "joints"), std::pair("/battery_state", "battery"),
          std::pair("/diagnostics", "diagnostics"), std::pair("/tf_static", "transforms latched"),
          std::pair("/robot_description", "text latched")})
      subscribe(peer, topic, type);
    EXPECT_THAT(next(peer, "/odom"), AllOf(HasSubstr("frame=odom"), HasSubstr("child=base_footprint")));
    EXPECT_THAT(next(peer, "/tf"), HasSubstr("odom>base_footprint"));
    EXPECT_THAT(next(peer, "/joint_states"), HasSubstr("left_wheel_joint:"));
    EXPECT_NEAR(number_in(next(peer, "/battery_state"), "voltage"), 12, 0.3);
    EXPECT_THAT(next(peer, "/diagnostics"), HasSubstr("connected"));
    // Published before this peer was there.
    EXPECT_TRUE(eventually([&] { return !peer.lines("got /tf_static ").empty(); }));
    EXPECT_TRUE(eventually([&] { return !peer.lines("got /robot_description").empty(); }));
  }
  static constexpr double kThere_m = 0.05;

  /// Turns to where the corner is, and drives there.
  static bool drive_to(PeerProgram& peer, const std::string& kind, double x_m, double y_m) {
    return eventually(
        [&] {
          const Pose at = pose(peer);
          const double left_m = std::hypot(x_m - at.x_m, y_m - at.y_m);
          if (left_m < kThere_m) return true;
          const double turn_rad =
              std::remainder(std::atan2(y_m - at.y_m, x_m - at.x_m) - at.heading_rad, 2 * std::numbers::pi);
          command(peer, kind, std::abs(turn_rad) < 0.3 ? std::clamp(left_m, 0.1, 0.4) : 0,
                  std::clamp(1.5 * turn_rad, -1.0, 1.0));
          return false;
        },
        std::chrono::seconds(60));
  }
};

TEST_F(Ros2, PeersOfBothKindsSeeWhatTheRobotDoes) {
  for (const PeerKind kind : kinds()) {
    PeerProgram peer(kind, support::test_domain());
    expect_to_see_the_robot(peer);
  }
}

TEST_F(Ros2, PeersOfBothKindsOnAnotherComputerSeeTheRobotAndCallIt) {
  support::test_domain();  // its name is of this computer
  const auto two = support::TwoComputers::make();
  if (!two) GTEST_SKIP() << "network namespaces take root and the command ip";
  start_node({"--range", "subnet"});
  std::vector<std::unique_ptr<PeerProgram>> peers;
  two->on_the_other([&] {
    for (const PeerKind kind : kinds())
      peers.push_back(std::make_unique<PeerProgram>(kind, support::test_domain(), "subnet"));
  });
  for (const auto& peer : peers) {
    expect_to_see_the_robot(*peer);
    for (const char* service :
         {"/emergency_stop", "/clear_faults", "/arm", "/stop", "/disarm", "/reset_odometry"})
      EXPECT_THAT(call(*peer, service), HasSubstr("yes")) << service;
    EXPECT_THAT(ask(*peer, "get /astrolabe c_R", "value"), HasSubstr("value c_R yes"));
  }
}

TEST_F(Ros2, PeersOfBothKindsDriveASquareByBothKindsOfCommand) {
  const std::vector<std::pair<double, double>> corners{{0.3, 0}, {0.3, 0.3}, {0, 0.3}, {0, 0}};
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(port()); }));
  support::forgive_late_hosts(port());
  for (const PeerKind kind : kinds()) {
    for (const char* command : {"twist", "twist_stamped"}) {
      const bool is_the_others = (kind == PeerKind::fast) == (command == std::string_view("twist"));
      if (is_the_others && !support::thorough()) continue;
      PeerProgram peer(kind, support::test_domain());
      subscribe(peer, "/odom", "odometry");
      next(peer, "/odom");
      EXPECT_THAT(call(peer, "/arm"), HasSubstr("yes"));
      for (const auto& [x_m, y_m] : corners) ASSERT_TRUE(drive_to(peer, command, x_m, y_m)) << command;
      EXPECT_THAT(call(peer, "/stop"), HasSubstr("yes"));
      EXPECT_TRUE(eventually([&] { return std::abs(number_in(next(peer, "/odom"), "v")) < 0.005; }));
      EXPECT_THAT(call(peer, "/disarm"), HasSubstr("yes"));
      const Pose at = pose(peer);
      EXPECT_LT(std::hypot(at.x_m, at.y_m), 3 * kThere_m);  // it ramps to rest
    }
  }
}

TEST_F(Ros2, EachServiceAnswersPeersOfBothKindsInTurnManyTimes) {
  const int times = support::how_often(20, 100);
  std::vector<std::unique_ptr<PeerProgram>> peers;
  for (const PeerKind kind : kinds())
    peers.push_back(std::make_unique<PeerProgram>(kind, support::test_domain()));
  subscribe(*peers[0], "/odom", "odometry");
  next(*peers[0], "/odom");
  // In an order in which the robot can do what is asked; what it cannot do is refused and says so: to arm with a fault, and to
  // go on after a stop.
  const std::vector<std::pair<std::string, std::string>> services{
      {"/arm", "yes"},   {"/pause", "yes"},       {"/resume", "yes"},         {"/stop", "yes"},
      {"/resume", "no"}, {"/disarm", "yes"},      {"/reset_odometry", "yes"}, {"/emergency_stop", "yes"},
      {"/arm", "no"},    {"/clear_faults", "yes"}};
  for (int i = 0; i < times; ++i)
    for (const auto& [service, answer] : services)
      for (const auto& peer : peers)
        ASSERT_THAT(call(*peer, service), HasSubstr(' ' + answer)) << service << i;
}

TEST_F(Ros2, PeersOfBothKindsSetAndReadParametersAndThePose) {
  for (const PeerKind kind : kinds()) {
    PeerProgram peer(kind, support::test_domain());
    subscribe(peer, "/odom", "odometry");
    next(peer, "/odom");
    const std::string value = kind == PeerKind::fast ? "1.0025" : "0.9975";
    EXPECT_THAT(ask(peer, "set /astrolabe c_R " + value, "set c_R"), HasSubstr("yes"));
    EXPECT_NEAR(std::stod(ask(peer, "get /astrolabe c_R", "value c_R yes").substr(13)), std::stod(value),
                1e-9);
    EXPECT_THAT(ask(peer, "set /astrolabe c_R 7.0", "set c_R no"), HasSubstr("0.5 to 1.5"));
    EXPECT_THAT(ask(peer, "describe /astrolabe b", "described b"), HasSubstr("Wheelbase"));
    EXPECT_THAT(ask(peer, "list /astrolabe", "names /astrolabe"), AllOf(HasSubstr("kappa0"), HasSubstr("b")));
    ask(peer, "pose /set_pose 1 2 0.5 odom", "sent /set_pose");
    EXPECT_TRUE(eventually([&] { return std::abs(pose(peer).y_m - 2) < 1e-6; }));
    EXPECT_NEAR(pose(peer).heading_rad, 0.5, 1e-6);
    call(peer, "/reset_odometry");
  }
}

TEST_F(Ros2, PulledCablesStopTheRobotAndAreRecoveredWithoutAJump) {
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(port()); }));
  node_port_ = (folder_.path() / "cable").string();
  test::PtyCable cable(port(), node_port_);
  start_node();
  PeerProgram peer(PeerKind::fast, support::test_domain());
  subscribe(peer, "/odom", "odometry");
  double worst_m = 0;
  const int pulls = support::how_often(4, 20);
  for (int i = 0; i < pulls; ++i) {
    next(peer, "/odom");
    ASSERT_THAT(call(peer, "/arm"), HasSubstr("yes")) << i;
    ask(peer, "drive /cmd_vel twist 0.3 0.5 0.5", "sent /cmd_vel");
    const Pose before = pose(peer);
    cable.pull();
    // It goes on being told to drive, and stops by its own time-out and a ramp from 0.3 m/s at 0.5 m/s^2: 0.8 s in all.
    ask(peer, "drive /cmd_vel twist 0.3 0.5 1.2", "sent /cmd_vel");
    cable.plug_in();
    const Pose after = pose(peer);
    EXPECT_LT(std::abs(number_in(next(peer, "/odom"), "v")), 0.01) << i;
    worst_m = std::max(worst_m, std::hypot(after.x_m - before.x_m, after.y_m - before.y_m));
    // Not without being armed again.
    ask(peer, "drive /cmd_vel twist 0.3 0.5 0.2", "sent /cmd_vel");
    EXPECT_LT(std::abs(number_in(next(peer, "/odom"), "v")), 0.01) << i;
  }
  std::printf("%d pulls: at most %.0f mm between the last message before and the first one after\n", pulls,
              1e3 * worst_m);
  // What it can have driven since the message before the pull: 0.3 m/s for some periods, 0.25 s and half of 0.6 s.
  EXPECT_LT(worst_m, 0.3);
  EXPECT_TRUE(node_->running());
}

TEST_F(Ros2, ThePtyGoesAndComesBackFiveTimesAndTheNodeStays) {
  PeerProgram peer(PeerKind::fast, support::test_domain());
  subscribe(peer, "/odom", "odometry");
  subscribe(peer, "/diagnostics", "diagnostics");
  for (int i = 0; i < 5; ++i) {
    next(peer, "/odom");
    EXPECT_THAT(call(peer, "/arm"), HasSubstr("yes"));
    ask(peer, "drive /cmd_vel twist 0.3 0.2 1", "sent /cmd_vel");
    const Pose before = pose(peer);
    robot_->send(SIGKILL);
    robot_->wait();
    const std::size_t until_here = peer.lines("got /diagnostics").size();
    EXPECT_TRUE(eventually([&] {
      const auto said = peer.lines("got /diagnostics");
      return said.size() > until_here && said.back().find("no robot") != std::string::npos;
    }));
    EXPECT_THAT(call(peer, "/arm"), HasSubstr("no robot"));
    start_robot();  // a robot that has restarted
    const Pose after = pose(peer);
    // It drove until it was killed, a message or two after the one that was seen.
    EXPECT_LT(std::hypot(after.x_m - before.x_m, after.y_m - before.y_m), 0.3);
    EXPECT_TRUE(node_->running());
  }
}

TEST_F(Ros2, WhileAnotherProgramDrivesArmIsRefusedAndSaysWhich) {
  PeerProgram peer(PeerKind::fast, support::test_domain());
  subscribe(peer, "/odom", "odometry");
  next(peer, "/odom");
  support::forgive_late_hosts(port());
  support::Program other(
      {ASTROLABE_PROGRAM, "drive", "velocity", "0.1", "0", "--for", "60", "--port", port()});
  EXPECT_TRUE(eventually([&] { return number_in(next(peer, "/odom"), "v") > 0.05; }));
  EXPECT_THAT(call(peer, "/arm"), AllOf(HasSubstr("no"), HasSubstr("drive velocity")));
  EXPECT_GT(number_in(next(peer, "/odom"), "v"), 0.05);
  // What stops is taken from everybody.
  EXPECT_THAT(call(peer, "/stop"), HasSubstr("yes"));
  EXPECT_EQ(other.wait(), 1);
  EXPECT_TRUE(eventually([&] { return call(peer, "/arm").find("yes") != std::string::npos; }));
}

TEST_F(Ros2, AnotherProgramStopsTheRobotAndItStaysStopped) {
  PeerProgram peer(PeerKind::fast, support::test_domain());
  subscribe(peer, "/odom", "odometry");
  subscribe(peer, "/diagnostics", "diagnostics");
  next(peer, "/odom");
  EXPECT_THAT(call(peer, "/arm"), HasSubstr("yes"));
  ask(peer, "drive /cmd_vel twist 0.3 0 0.5", "sent /cmd_vel");
  EXPECT_EQ(support::astrolabe({"stop", "--port", port()}).code, 0);
  ask(peer, "drive /cmd_vel twist 0.3 0 1.5", "sent /cmd_vel");
  EXPECT_LT(std::abs(number_in(next(peer, "/odom"), "v")), 0.01);
  EXPECT_TRUE(eventually([&] { return next(peer, "/diagnostics").find("ignored") != std::string::npos; }));
}

// By its own time-out, or by the Hello of the next program at the port.
TEST_F(Ros2, ARobotWhoseNodeIsKilledStops) {
  PeerProgram peer(PeerKind::fast, support::test_domain());
  subscribe(peer, "/odom", "odometry");
  next(peer, "/odom");
  EXPECT_THAT(call(peer, "/arm"), HasSubstr("yes"));
  ask(peer, "drive /cmd_vel twist 0.4 0 1", "sent /cmd_vel");
  node_->send(SIGKILL);
  node_->wait();
  const auto mode = [&] {
    const auto outcome = support::astrolabe({"info", "--json", "--port", port()});
    return outcome.code == 0 ? support::parse_json(outcome.out)["mode"].get<std::string>() : outcome.err;
  };
  EXPECT_TRUE(eventually([&] { return mode() == "idle" || mode() == "fault"; })) << mode();
  const auto gone = [&] {
    const std::size_t before = peer.lines("writer /odom").size();
    ask(peer, "writers /odom", "writers /odom");
    return peer.lines("writer /odom").size() == before;
  };
  EXPECT_TRUE(eventually(gone, std::chrono::seconds(10))) << "others need not wait for the 20 s of Fast DDS";
}

TEST_F(Ros2, WhatAKilledNodeLeftDrivingWithoutATimeOutIsStoppedByTheNextOne) {
  PeerProgram peer(PeerKind::fast, support::test_domain());
  subscribe(peer, "/odom", "odometry");
  next(peer, "/odom");  // the robot is there
  set_no_timeout();
  EXPECT_THAT(call(peer, "/arm"), HasSubstr("yes"));
  ask(peer, "drive /cmd_vel twist 0.2 0.5 1", "sent /cmd_vel");
  node_->send(SIGKILL);
  node_->wait();
  start_node();
  EXPECT_TRUE(eventually([&] { return std::abs(number_in(next(peer, "/odom"), "v")) < 0.005; }));
}

TEST_F(Ros2, ADriveOfAnotherProgramGoesOnWhenANodeStarts) {
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(port()); }));
  set_no_timeout();
  node_->send(SIGINT);
  node_->wait();
  support::Program other(
      {ASTROLABE_PROGRAM, "drive", "velocity", "0.1", "0.5", "--for", "60", "--port", port()});
  start_node();
  PeerProgram peer(PeerKind::fast, support::test_domain());
  subscribe(peer, "/odom", "odometry");
  EXPECT_TRUE(eventually([&] { return number_in(next(peer, "/odom"), "v") > 0.05; }));
  for (int i = 0; i < 50; ++i) ASSERT_GT(number_in(next(peer, "/odom"), "v"), 0.05);
  EXPECT_TRUE(other.running());
  EXPECT_THAT(node_->err(), testing::Not(HasSubstr("it was stopped")));
}

TEST_F(Ros2, AVelocityOfTheOtherTypeIsNamedWithWhatTakesIt) {
  start_node({}, "TwistStamped");
  PeerProgram peer(PeerKind::fast, support::test_domain());
  peer.say("twist /cmd_vel 0 0");  // nobody reads it
  EXPECT_TRUE(eventually([&] {
    return node_->err().find(
               "publishes /cmd_vel as geometry_msgs/msg/Twist, which is not taken: --cmd-vel Twist") !=
           std::string::npos;
  }));
}

TEST_F(Ros2, TheArgumentsOfALaunchFileNameTheNodeItsTopicsAndItsParameters) {
  start_node({"--ros-args", "-r", "__node:=base", "-r", "__ns:=/left", "-r", "odom:=/hall/odometry", "-p",
              "c_R:=1.002", "-p", "publish_rate:=20", "--"});
  PeerProgram peer(PeerKind::fast, support::test_domain());
  subscribe(peer, "/hall/odometry", "odometry");
  EXPECT_THAT(next(peer, "/hall/odometry"), HasSubstr("child=left/base_footprint"));
  EXPECT_THAT(ask(peer, "get /left/base publish_rate", "value publish_rate"), HasSubstr("20"));
  EXPECT_TRUE(eventually(
      [&] { return ask(peer, "get /left/base c_R", "value c_R").find("1.002") != std::string::npos; }));
  start_node({"--ros-args", "-p", "publish_rate:=fast"});
  EXPECT_EQ(node_->wait(), 2);
  EXPECT_THAT(node_->err(), HasSubstr("publish_rate has to be a number from 1 to 1000"));
}

TEST_F(Ros2, CtrlCBringsTheRobotToRestAndEnds) {
  PeerProgram peer(PeerKind::fast, support::test_domain());
  subscribe(peer, "/odom", "odometry");
  next(peer, "/odom");
  EXPECT_THAT(call(peer, "/arm"), HasSubstr("yes"));
  ask(peer, "drive /cmd_vel twist 0.4 0 1", "sent /cmd_vel");
  node_->send(SIGINT);
  EXPECT_EQ(node_->wait(), 0);
  const auto info = support::astrolabe({"info", "--json", "--port", port()});
  EXPECT_THAT(info.out, AllOf(HasSubstr("disarmed"), testing::Not(HasSubstr("command_timeout"))));
}

TEST_F(Ros2, TheCovarianceOfACalibrationIsThatOfItsFactorsOnly) {
  const std::string file = (folder_.path() / "calib.toml").string();
  std::ofstream(file) << "[parameters]\nc_R = 1.002\nc_L = 0.998\nb = 0.2886\n";
  start_node({"--calibration", file});
  EXPECT_EQ(node_->wait(), 1);
  EXPECT_THAT(node_->err(), HasSubstr("how well its factors are known"));

  std::ofstream(file, std::ios::app)
      << "[covariance]\nmatrix = [[1e-8, 0, 0, 0], [0, 1e-8, 0, 0], [0, 0, 1e-8, 0], "
         "[0, 0, 0, 0]]\n[slip]\nK = 1e-6\n";
  start_node({"--calibration", file});
  PeerProgram peer(PeerKind::fast, support::test_domain());
  subscribe(peer, "/diagnostics", "diagnostics");
  // The robot was never loaded with that calibration.
  EXPECT_TRUE(
      eventually([&] { return next(peer, "/diagnostics").find("other factors") != std::string::npos; }));
  ASSERT_EQ(
      support::astrolabe({"params", "set", "c_R=1.002", "c_L=0.998", "b=0.2886", "--yes", "--port", port()})
          .code,
      0);
  node_->send(SIGINT);
  node_->wait();
  start_node({"--calibration", file});
  EXPECT_TRUE(eventually([&] { return next(peer, "/diagnostics").find("disarmed") != std::string::npos; }));
}

TEST_F(Ros2, WrongNamesAreRefusedInOneSentence) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--node-name", "1st"}, std::vector<std::string>{"--namespace", "a//b"}}) {
    start_node(options);
    EXPECT_EQ(node_->wait(), 2);
    EXPECT_THAT(node_->err(), HasSubstr("astrolabe: " + options[0]));
  }
}

}  // namespace
}  // namespace astro
