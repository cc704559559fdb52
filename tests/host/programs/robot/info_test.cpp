#include <gmock/gmock.h>
#include <stdlib.h>

#include "common/protocol/session.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/links/pty.hpp"
#include "tests/support/programs/program.hpp"

// What the program reports about a robot: info, ports, monitor, faults; and where the simulator puts its
// links.
namespace astro {
namespace {

using nlohmann::json;
using support::astrolabe;
using support::Outcome;
using support::Simulator;
using testing::HasSubstr;

// Programs of a test see the simulators of that test only.
class Desk : public testing::Test {
 protected:
  Desk() { setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~Desk() override { unsetenv("XDG_RUNTIME_DIR"); }
  test::TemporaryFolder folder_;
};

using Info = Desk;
using Ports = Desk;
using Monitor = Desk;
using Faults = Desk;
using Sim = Desk;

TEST_F(Info, SaysWhoTheRobotIsAndHow) {
  const Simulator simulator;
  const Outcome outcome = astrolabe({"info", "--port", simulator.port(), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json info = support::parse_json(outcome.out);
  EXPECT_EQ(info["name"], "ASTRO");
  EXPECT_EQ(info["board"], "sim");
  EXPECT_EQ(info["protocol"], protocol::kProtocolVersion);
  EXPECT_EQ(info["mode"], "disarmed");
  EXPECT_EQ(info["faults"], json::array());
  EXPECT_NEAR(info["battery_V"], 12.0, 0.1);  // supply_V of the simulated robot, at rest
  EXPECT_EQ(info["tick_overruns"], 0);
  EXPECT_EQ(info["id"].get<std::string>().size(), 32U);
  EXPECT_GT(info["uptime_s"], 0);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Info, FindsTheOnlyRobotByItself) {
  const Simulator simulator;
  const Outcome outcome = astrolabe({"info"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ASTRO"));
}

TEST_F(Info, OfNoRobotSaysWhatToDo) {
  const Outcome outcome = astrolabe({"info"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("astrolabe sim"));
}

TEST_F(Info, OfSeveralRobotsListsThem) {
  const Simulator one, other;
  const Outcome outcome = astrolabe({"info"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err,
              testing::AllOf(HasSubstr("--port"), HasSubstr("robot.pty"), HasSubstr("robot-2.pty")));
}

TEST_F(Info, TellsRobotsOfDifferentSeedsApart) {
  const Simulator one({"--seed", "1"}), other({"--seed", "2"});
  const auto id = [](const Simulator& robot) {
    return support::parse_json(astrolabe({"info", "--json", "--port", robot.port()}).out)["id"];
  };
  EXPECT_NE(id(one), id(other));
  EXPECT_EQ(id(one), id(one));
}

TEST_F(Ports, ListsSimulatorsWhereverTheyAre) {
  const Simulator simulator;
  const json found = support::parse_json(astrolabe({"ports", "--json"}).out);
  ASSERT_EQ(found.size(), 1U);  // assumes that this machine has no serial port
  EXPECT_TRUE(found[0]["simulator"]);
  EXPECT_EQ(found[0]["robot"]["name"], "ASTRO");
  EXPECT_EQ(astrolabe({"info", "--port", found[0]["port"]}).code, 0);
}

TEST_F(Ports, OfAnEmptyDeskAreNone) {
  const Outcome outcome = astrolabe({"ports", "--json"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(support::parse_json(outcome.out), json::array());
  EXPECT_EQ(astrolabe({"ports"}).out, "");
}

TEST_F(Sim, TakesItsLinksAwayWhenItEnds) {
  for (const int signal : {SIGTERM, SIGINT}) {
    Simulator simulator;
    simulator.program().send(signal);
    EXPECT_EQ(simulator.program().wait(), 0);
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(simulator.port())));
    EXPECT_EQ(support::parse_json(astrolabe({"ports", "--json"}).out), json::array());
    EXPECT_TRUE(std::filesystem::is_empty(*std::filesystem::directory_iterator(folder_.path())));
  }
}

TEST_F(Sim, WithAPathOfItsOwnNeedsNoRuntimeFolder) {
  setenv("XDG_RUNTIME_DIR", "/no/such/folder", 1);
  const Simulator simulator;
  EXPECT_EQ(astrolabe({"info", "--port", simulator.port()}).code, 0);
  const Outcome outcome = astrolabe({"sim"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("XDG_RUNTIME_DIR"));
}

TEST_F(Sim, LeavesARunningOneAlone) {
  const Simulator simulator;
  const Outcome outcome = astrolabe({"sim", "--pty", simulator.port()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("in use by another simulator"));
  EXPECT_EQ(astrolabe({"info", "--port", simulator.port()}).code, 0);
}

TEST_F(Sim, TakesThePlaceOfOneThatWasKilled) {
  const auto path = folder_.path() / "robot.pty";
  support::Program first({ASTROLABE_PROGRAM, "sim", "--pty", path});
  ASSERT_TRUE(support::eventually([&] { return first.err().find("next") != std::string::npos; }));
  first.send(SIGKILL);
  first.wait();
  support::Program second({ASTROLABE_PROGRAM, "sim", "--pty", path});
  ASSERT_TRUE(support::eventually([&] { return second.err().find("next") != std::string::npos; }))
      << second.err();
  EXPECT_EQ(astrolabe({"info", "--port", path}).code, 0);
}

TEST_F(Sim, TakesThePlaceOfADeadOneWhoseTerminalIsAnotherProgramsNow) {
  const auto path = folder_.path() / "robot.pty";
  const test::Pty anothers;
  std::filesystem::create_symlink(anothers.path(), path);
  support::Program simulator({ASTROLABE_PROGRAM, "sim", "--pty", path});
  ASSERT_TRUE(support::eventually([&] { return simulator.err().find("next") != std::string::npos; }))
      << simulator.err();
  EXPECT_EQ(astrolabe({"info", "--port", path}).code, 0);
}

std::string id_at(const std::string& port) {
  const Outcome outcome = astrolabe({"info", "--json", "--port", port});
  return outcome.code == 0 ? support::parse_json(outcome.out)["id"].get<std::string>() : outcome.err;
}

TEST_F(Sim, IsAnotherRobotThanOneBesideItAndTheSameAtEachStart) {
  const Simulator one, other;
  const std::string id = id_at(one.port());
  EXPECT_NE(id, id_at(other.port()));
  const auto path = folder_.path() / "robot.pty";
  std::string first;
  for (int start = 0; start < 2; ++start) {
    support::Program again({ASTROLABE_PROGRAM, "sim", "--pty", path});
    ASSERT_TRUE(support::eventually([&] { return again.err().find("next") != std::string::npos; }));
    if (start == 0) first = id_at(path);
    EXPECT_EQ(id_at(path), first);
  }
}

TEST_F(Sim, IsTheRobotOfItsFlashWhichNoOtherOneUsesMeanwhile) {
  const std::string flash = folder_.path() / "flash", here = folder_.path() / "here.pty",
                    there = folder_.path() / "there.pty";
  std::string first;
  {
    support::Program robot({ASTROLABE_PROGRAM, "sim", "--pty", here, "--flash", flash});
    ASSERT_TRUE(support::eventually([&] { return robot.err().find("next") != std::string::npos; }));
    first = id_at(here);
    const Outcome second = astrolabe({"sim", "--pty", there, "--flash", flash});
    EXPECT_EQ(second.code, 1);
    EXPECT_THAT(second.err,
                HasSubstr("flash' is in use by another simulator: stop it or choose another --flash"));
  }
  support::Program robot({ASTROLABE_PROGRAM, "sim", "--pty", there, "--flash", flash});
  ASSERT_TRUE(support::eventually([&] { return robot.err().find("next") != std::string::npos; }))
      << robot.err();
  EXPECT_EQ(id_at(there), first);
}

TEST_F(Sim, ThatWasKilledLeavesNoWayToTheRobotThatGetsItsTerminal) {
  const std::string dead = folder_.path() / "dead", alive = folder_.path() / "alive";
  support::Program first({ASTROLABE_PROGRAM, "sim", "--pty", dead});
  ASSERT_TRUE(support::eventually([&] { return first.err().find("next") != std::string::npos; }));
  first.send(SIGKILL);
  first.wait();
  support::Program second({ASTROLABE_PROGRAM, "sim", "--pty", alive});
  ASSERT_TRUE(support::eventually([&] { return second.err().find("next") != std::string::npos; }));
  for (const std::vector<std::string>& words : {std::vector<std::string>{"info", "--port", dead},
                                                {"params", "set", "b=0.31", "--yes", "--port", dead}}) {
    const Outcome outcome = astrolabe(words);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr(dead + " has nothing behind it"));
  }
  EXPECT_EQ(support::parse_json(astrolabe({"ports", "--json"}).out).size(), 1U);
  EXPECT_THAT(astrolabe({"params", "get", "b", "--port", alive}).out, HasSubstr("0.29"));
}

TEST_F(Monitor, PrintsOneLineOfJsonPerSample) {
  const Simulator simulator;
  const Outcome outcome = astrolabe({"monitor", "--port", simulator.port(), "--count", "5", "--rate", "50"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::string line;
  double last_s = 0;
  int count = 0;
  while (std::getline(lines, line)) {
    const json sample = support::parse_json(line);
    if (count++ > 0) {
      EXPECT_NEAR(sample["time_s"].get<double>() - last_s, 0.02, 1e-9);  // on the robot's clock, exact
    }
    last_s = sample["time_s"];
    EXPECT_EQ(sample["mode"], "disarmed");
    EXPECT_EQ(sample["left"]["duty"], 0);
  }
  EXPECT_EQ(count, 5);
}

TEST_F(Faults, AreNoneAtTheStart) {
  const Simulator simulator;
  EXPECT_EQ(astrolabe({"faults", "--port", simulator.port()}).out, "no fault is latched\n");
}

TEST_F(Faults, OfAnEmergencyStopHoldUntilTheyAreCleared) {
  const Simulator simulator;
  const auto port = simulator.port();
  EXPECT_EQ(astrolabe({"stop", "--emergency", "--port", port}).code, 0);
  const Outcome refused = astrolabe({"drive", "line", "1", "--port", port});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("emergency_stop"));
  EXPECT_EQ(refused.out, "");
  const json report = support::parse_json(astrolabe({"faults", "--clear", "--json", "--port", port}).out);
  EXPECT_EQ(report["latched"], json::array({"emergency_stop"}));
  EXPECT_EQ(report["first"], "emergency_stop");
  EXPECT_EQ(astrolabe({"drive", "line", "0.1", "--port", port}).code, 0);
}

}  // namespace
}  // namespace astro
