#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <utility>

#include "tests/support/base/json.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/ros2/domain.hpp"

// Ground truth by VRPN, NatNet and ROS 2 from a simulator's virtual tracker, in real time, as from a lab's.
namespace astro {
namespace {

namespace fs = std::filesystem;
using support::astrolabe;
using support::PatientSimulator;
using support::Simulator;
using testing::HasSubstr;

/// "vrpn://127.0.0.1:PORT/ASTRO" or "ros2:/TOPIC?domain=N", as the simulator said it.
std::string address_of(Simulator& simulator, const std::string& protocol = "vrpn") {
  const std::string said = simulator.program().err();
  const std::size_t at = said.find(protocol + ":/");
  return at == std::string::npos ? "" : said.substr(at, said.find('\n', at) - at);
}

/// Topics of a run of the tests, in a domain that no other run uses. All programs that the test starts are in it.
std::string own_topic(const std::string& name) {
  setenv("ROS_DOMAIN_ID", std::to_string(support::test_domain()).c_str(), 1);
  return "/" + name + "/pose";
}

/// A robot that slips like the thesis's, and a tracker that loses every tenth pose and sends the others 30 ms late by each
/// protocol.
std::vector<std::string> lab(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> options{"--vrpn-port", "0", "--natnet-port", "0", "--ros2-topic", own_topic(name)};
  for (const char* option :
       {"--tracker-latency", "0.03", "--tracker-drops", "0.1", "--slip", "2.645e-6", "--true-ed", "1.00416"})
    options.emplace_back(option);
  options.insert(options.end(), more.begin(), more.end());
  return options;
}

/// A recorder in the background, which has begun when constructed.
struct Recorder {
  Recorder(const Simulator& simulator, const std::string& truth, const std::string& name)
      : folder(simulator.folder() / name),
        program({ASTROLABE_PROGRAM, "record", "--port", simulator.port(), "--truth", truth, "--out",
                 (fs::create_directory(folder), (folder / "run.mcap").string())}) {
    EXPECT_TRUE(support::eventually([&] {
      return program.err().find("recording; Ctrl-C ends it") != std::string::npos;
    })) << program.err();
  }
  nlohmann::json calibration() {
    program.send(SIGINT);
    EXPECT_EQ(program.wait(), 0) << program.err();
    const support::Outcome outcome = astrolabe({"calibrate", "runs", folder.string(), "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return support::parse_json(outcome.out);
  }
  fs::path folder;
  support::Program program;
};

TEST(TrackerOnTheNetwork, IsNotServedFasterThanTime) {
  const support::Outcome outcome = astrolabe({"sim", "--fast", "--vrpn-port", "0"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("leave it out, or --vrpn-port"));
  const support::Outcome ros2 = astrolabe({"sim", "--fast", "--ros2-topic", "/pose"});
  EXPECT_EQ(ros2.code, 2);
  EXPECT_THAT(ros2.err, HasSubstr("leave it out, or --ros2-topic"));
}

TEST(TrackerOnTheNetwork, GivesTheFactorsThatTheSimulatorsOwnTruthGives) {
  PatientSimulator simulator(
      lab("ASTRO", {"--tracker-ahead", "0.08", "--tracker-left", "-0.03", "--seed", "5"}));
  ASSERT_TRUE(support::eventually([&] { return !address_of(simulator, "natnet").empty(); }));
  Recorder tracked(simulator, address_of(simulator), "vrpn"), own(simulator, "sim", "sim"),
      optitrack(simulator, address_of(simulator, "natnet"), "natnet"),
      node(simulator, address_of(simulator, "ros2"), "ros2");
  ASSERT_EQ(astrolabe({"drive", "square", "0.4", "--ccw", "--port", simulator.port()}).code, 0);
  const nlohmann::json vrpn = tracked.calibration(), sim = own.calibration(),
                       natnet = optitrack.calibration(), ros2 = node.calibration();
  EXPECT_THAT(tracked.program.err(), HasSubstr("'ASTRO' from 127.0.0.1:"));
  EXPECT_THAT(tracked.program.err(),
              testing::ContainsRegex("(59|60)\\.[0-9] poses per second, times by the tracker's clock"));
  EXPECT_THAT(
      node.program.err(),
      testing::ContainsRegex("'/ASTRO/pose' from ROS 2 as geometry_msgs/msg/PoseStamped in 'world' by the "
                             "node /virtual_tracker, (59|60)\\.[0-9] poses per second, times by the "
                             "tracker's clock"));
  // All saw the same drive with the same noise, so wheel slip, the greatest part of the error, is common. What
  // differs is 10 % of the poses, and the offset of the clocks, which the simulator's own need not find.
  for (const char* factor : {"c_R", "c_L", "b_m"}) {
    const double error = sim["standard_errors"][factor], own_value = sim[factor];
    for (const auto& [name, tracked_by] : {std::pair{"VRPN", &vrpn}, {"NatNet", &natnet}, {"ROS 2", &ros2}}) {
      const double apart = ((*tracked_by)[factor].get<double>() - own_value) / error;
      std::printf("  %s by %s: %.2f standard errors apart\n", factor, name, apart);
      EXPECT_LE(std::abs(apart), 0.5) << factor << " by " << name;
    }
  }
  for (const auto& [axis, true_m] : {std::pair{"x_m", 0.08}, {"y_m", -0.03}})
    EXPECT_NEAR(vrpn["sessions"][0]["lever_arm"][axis].get<double>(), true_m,
                4 * vrpn["sessions"][0]["lever_arm_se"][axis].get<double>())
        << axis;
}

/// A whole experiment in the background, with a robot of its own.
struct WholeExperiment {
  explicit WholeExperiment(const std::string& truth)
      : simulator(lab(truth, {"--seed", "7"})),
        program({ASTROLABE_PROGRAM, "umbmark", "--port", simulator.port(), "--truth",
                 truth == "sim" ? truth : served(truth), "--runs", "1", "--side", "0.4", "--no-extras",
                 "--yes", "--force", "--out", (simulator.folder() / "lab").string(), "--json"}) {}

  nlohmann::json calibration() {
    const int code = program.wait();
    EXPECT_EQ(code, 0) << program.err();
    return support::parse_json(program.out())["phases"][0]["estimate"];
  }

  std::string served(const std::string& protocol) {
    EXPECT_TRUE(support::eventually([&] { return !address_of(simulator, protocol).empty(); }));
    return address_of(simulator, protocol);
  }

  PatientSimulator simulator;
  support::Program program;
};

TEST(TrackerOnTheNetwork, CalibratesInAWholeExperimentAsTheSimulatorsOwnTruthDoes) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  WholeExperiment own("sim"), by_vrpn("vrpn"), by_natnet("natnet"), by_ros2("ros2");
  const nlohmann::json sim = own.calibration(), vrpn = by_vrpn.calibration(),
                       natnet = by_natnet.calibration(), ros2 = by_ros2.calibration();
  for (const char* factor : {"c_R", "c_L", "b_m"})
    for (const auto& [name, tracked] : {std::pair{"VRPN", &vrpn}, {"NatNet", &natnet}, {"ROS 2", &ros2}}) {
      const double error = std::hypot(sim["standard_errors"][factor].get<double>(),
                                      (*tracked)["standard_errors"][factor].get<double>());
      const double apart = ((*tracked)[factor].get<double>() - sim[factor].get<double>()) / error;
      std::printf("  %s by %s: %.2f standard errors apart\n", factor, name, apart);
      // The robots slip alike as long as commands reach them at the same ticks, and then a few hundredths is seen. Where a
      // command comes a tick later, this is a draw from a normal distribution.
      EXPECT_LE(std::abs(apart), 3) << factor;
    }
}

TEST(TrackerOnTheNetwork, IsWatchedLive) {
  Simulator simulator({"--vrpn-port", "0"});
  ASSERT_TRUE(support::eventually([&] { return !address_of(simulator).empty(); }));
  const support::Outcome outcome =
      astrolabe({"truth", "watch", address_of(simulator), "--seconds", "4", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("'ASTRO' over TCP"));
  const std::size_t last = outcome.out.rfind('\n', outcome.out.size() - 2) + 1;
  const nlohmann::json report = support::parse_json(outcome.out.substr(last));
  EXPECT_NEAR(report["rate_hz"].get<double>(), 60, 1);
  EXPECT_EQ(report["lost"], 0);
  // The cameras of the simulator have 0.2 mm and 1 mrad; the robot stands. Of 180 poses they are good to 5 %.
  EXPECT_NEAR(report["noise_at_rest"]["position_m"].get<double>(), 2e-4, 4e-5);
  EXPECT_NEAR(report["noise_at_rest"]["heading_rad"].get<double>(), 1e-3, 2e-4);
}

TEST(TrackerOnTheNetwork, IsWatchedUntilSomebodyEndsIt) {
  Simulator simulator({"--vrpn-port", "0"});
  ASSERT_TRUE(support::eventually([&] { return !address_of(simulator).empty(); }));
  for (const int signal : {SIGINT, SIGTERM}) {
    support::Program watch({ASTROLABE_PROGRAM, "truth", "watch", address_of(simulator)});
    EXPECT_TRUE(support::eventually([&] { return watch.out().find("Hz") != std::string::npos; }));
    watch.send(signal);
    EXPECT_EQ(watch.wait(), 0) << watch.err();
  }
}

TEST(TrackerOnTheNetwork, IsWatchedLiveInRos2AlsoIfItListensOnAllNetworks) {
  setenv("ROS_STATIC_PEERS", "127.0.0.1", 1);
  Simulator simulator({"--ros2-topic", own_topic("watched")});
  unsetenv("ROS_STATIC_PEERS");  // the watching program listens on loopback alone
  const support::Outcome outcome =
      astrolabe({"truth", "watch", "ros2:/watched/pose", "--seconds", "4", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("'/watched/pose' as geometry_msgs/msg/PoseStamped in 'world' by "));
  const std::size_t last = outcome.out.rfind('\n', outcome.out.size() - 2) + 1;
  EXPECT_NEAR(support::parse_json(outcome.out.substr(last))["rate_hz"].get<double>(), 60, 1);
}

TEST(TrackerOnTheNetwork, ATopicThatNobodyPublishesIsAnErrorThatListsThoseThatAre) {
  Simulator simulator({"--ros2-topic", own_topic("there")});
  const support::Outcome outcome = astrolabe({"truth", "watch", "ros2:/missing", "--seconds", "2"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err,
              HasSubstr("nobody publishes /missing in the domain " + std::to_string(support::test_domain()) +
                        " of this computer; poses are on /there/pose "
                        "(geometry_msgs/msg/PoseStamped); only this computer is looked at"));
}

TEST(TrackerOnTheNetwork, WhatTheRobotsOwnNodePublishesIsRefused) {
  Simulator simulator({"--ros2-topic", own_topic("tracker")});
  const support::Program node({ASTROLABE_PROGRAM, "ros2", "--port", simulator.port()});
  for (const char* address : {"ros2:/odom", "ros2:/tf?parent=odom&child=base_link"}) {
    const support::Outcome outcome = astrolabe({"truth", "watch", address, "--seconds", "10"});
    EXPECT_EQ(outcome.code, 1) << address;
    EXPECT_THAT(outcome.err, HasSubstr("they are what the robot computes from its own wheels")) << address;
  }
}

TEST(TrackerOnTheNetwork, AWatchOfNothingEndsWithTheReason) {
  const support::Outcome outcome =
      astrolabe({"truth", "watch", "vrpn://127.0.0.1:1/ASTRO", "--seconds", "1"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no ground truth came from 127.0.0.1:1: nothing answers there"));
}

TEST(TrackerOnTheNetwork, AnAddressThatIsNoneIsWrongUsage) {
  for (const char* address : {"vrpn:/lab", "vrpn://", "vrpn://lab:0/ASTRO", "vrpn://lab/ASTRO?up=x",
                              "ros2://lab/tf", "ros2:tf", "tape"}) {
    const support::Outcome outcome = astrolabe({"record", "--truth", address, "--out", "/tmp/x.mcap"});
    EXPECT_EQ(outcome.code, 2) << address;
    EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("--truth"), HasSubstr(address)));
  }
}

}  // namespace
}  // namespace astro
