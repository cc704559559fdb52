#include "host/robot/port/ports.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "host/robot/client/discovery.hpp"
#include "host/robot/client/handshake.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/links/pty.hpp"
#include "tests/support/programs/served_robot.hpp"

namespace astro::robot {
namespace {

namespace fs = std::filesystem;
using support::Tells;
using test::Pty;
using test::ServedRobot;
using test::TemporaryFolder;

TEST(Ports, ListsEachDeviceOnceUnderItsLastingName) {
  const TemporaryFolder dev;
  fs::create_directories(dev.path() / "serial" / "by-id");
  for (const char* name : {"ttyACM0", "ttyACM1", "ttyUSB0", "ttyS0", "null"})
    std::ofstream(dev.path() / name);
  fs::create_symlink("../../ttyACM1", dev.path() / "serial" / "by-id" / "usb-Teensyduino");
  const auto ports = candidate_ports(dev.path(), dev.path() / "no_simulators");
  ASSERT_EQ(ports.size(), 3U);
  EXPECT_EQ(ports[0].address, dev.path() / "serial" / "by-id" / "usb-Teensyduino");
  EXPECT_EQ(ports[0].device, dev.path() / "ttyACM1");
  EXPECT_EQ(ports[1].address, dev.path() / "ttyACM0");
  EXPECT_EQ(ports[2].address, dev.path() / "ttyUSB0");
}

TEST(Ports, LeavesOutSimulatorsThatHaveEnded) {
  const TemporaryFolder folder;
  const Pty alive;
  fs::create_symlink(alive.path(), folder.path() / "alive.pty");
  fs::create_symlink("/dev/pts/nobody", folder.path() / "dead.pty");
  fs::create_symlink(alive.path(), folder.path() / "not_a_simulator.txt");
  const auto ports = candidate_ports(folder.path(), folder.path());
  ASSERT_EQ(ports.size(), 1U);
  EXPECT_EQ(ports[0].address, folder.path() / "alive.pty");
  EXPECT_EQ(ports[0].device, alive.path());
  EXPECT_TRUE(ports[0].simulator);
}

TEST(Ports, RuntimeFolderIsThisUsersOwn) {
  const TemporaryFolder folder;
  ASSERT_EQ(::setenv("XDG_RUNTIME_DIR", folder.path().c_str(), 1), 0);
  EXPECT_EQ(runtime_folder(), folder.path() / ("astrolabe-" + std::to_string(::getuid())));
  ASSERT_EQ(::unsetenv("XDG_RUNTIME_DIR"), 0);
  EXPECT_EQ(runtime_folder(), "/tmp/astrolabe-" + std::to_string(::getuid()));
}

TEST(Ports, FindsRobotsAndSaysWhyTheOthersAreNone) {
  const TemporaryFolder folder;
  const Pty silent, busy, live;
  fs::create_symlink(silent.path(), folder.path() / "a_silent.pty");
  fs::create_symlink(busy.path(), folder.path() / "b_busy.pty");
  fs::create_symlink(live.path(), folder.path() / "c_live.pty");
  const auto holder = open_transport(busy.path());
  const ServedRobot robot(live.master());
  SharedPorts shared;
  const auto found =
      find_robots(shared, candidate_ports(folder.path(), folder.path()), std::chrono::seconds(3));
  ASSERT_EQ(found.size(), 3U);
  EXPECT_THAT(found[0].reason, Tells(HandshakeProblem::nothing_comes, found[0].port.address));
  EXPECT_THAT(found[1].reason, Tells(PortProblem::in_use, found[1].port.address));
  ASSERT_TRUE(found[2].robot) << found[2].reason.sentence;
  EXPECT_EQ(found[2].robot->robot_name.view(), "astro");
  EXPECT_FALSE(found[0].robot || found[1].robot);
}

TEST(Ports, AreAskedAllAtOnce) {
  std::vector<Pty> silent(8);
  std::vector<Port> ports;
  for (const Pty& pty : silent) ports.push_back({pty.path(), pty.path(), false});
  const auto begun = std::chrono::steady_clock::now();
  SharedPorts shared;
  const auto found = find_robots(shared, ports, std::chrono::seconds(2));
  // One after the other they cannot take less.
  EXPECT_LT(std::chrono::steady_clock::now() - begun, 8 * std::chrono::seconds(2));
  ASSERT_EQ(found.size(), ports.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].port.address, ports[i].address);
    EXPECT_FALSE(found[i].robot);
    EXPECT_THAT(found[i].reason, Tells(HandshakeProblem::nothing_comes, ports[i].address));
  }
}

}  // namespace
}  // namespace astro::robot
