#include "host/robot/sharing/shared_port.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <functional>
#include <memory>
#include <optional>

#include "host/robot/client/client.hpp"
#include "host/robot/port/serial_port.hpp"
#include "host/robot/sharing/port_socket.hpp"
#include "host/robot/sharing/relay_messages.hpp"
#include "host/robot/sharing/relay_server.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/links/pty.hpp"
#include "tests/support/programs/served_robot.hpp"

// One port and several programs: what only an operating system can show. The other programs are connections
// of this process, or child processes if a program has to be killed.
namespace astro::robot {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using support::Tells;
using support::ThrowsTelling;
using test::Pty;
using test::ServedRobot;

class SharedPortOfTheSystem : public testing::Test {
 protected:
  std::string key() const {
    struct stat about {};
    ::stat(pty.path().c_str(), &about);
    return port_key(about);
  }
  bool somebody_listens() const { return static_cast<bool>(connect_to(key(), seconds(1)).connection); }

  Remark why_not() {
    return support::told_by([&] { ports.open(pty.path()); });
  }

  bool is_free() const {
    try {
      open_transport(pty.path());
    } catch (const Error&) {
      return false;
    }
    return true;
  }

  /// A child process that holds the port, reports it and waits to be ended.
  pid_t holder_in_a_child() {
    int ready[2];
    if (::pipe(ready) != 0) throw std::runtime_error("no pipe");
    const pid_t child = ::fork();
    if (child == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that fails leaves nobody behind
      const auto transport = ports.open(pty.path());
      const char byte = 1;
      if (::write(ready[1], &byte, 1) == 1) ::pause();
      ::_exit(0);
    }
    char byte = 0;
    if (::read(ready[0], &byte, 1) != 1) throw std::runtime_error("the child does not hold the port");
    ::close(ready[0]);
    ::close(ready[1]);
    return child;
  }

  Pty pty;
  SharedPorts ports;
};

TEST_F(SharedPortOfTheSystem, TheSecondProgramWorksAsIfItHadThePort) {
  const ServedRobot robot(pty.master());
  Client first(ports.open(pty.path()));
  first.connect();
  Client second(ports.open(pty.path()));
  EXPECT_EQ(second.connect().robot_name.view(), "astro");
  EXPECT_EQ(second.request(protocol::GetParameterInfo{2}).name.view(), "b");
  EXPECT_EQ(first.request(protocol::GetParameterInfo{0}).name.view(), "c_R");
  EXPECT_EQ(second.name(), pty.path());
}

/// The exit code of a program of user 65534.
int as_another_user(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(::setgid(65'534) == 0 && ::setuid(65'534) == 0 ? work() : 99);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 98;
}

TEST_F(SharedPortOfTheSystem, AProgramOfAnotherUserIsNotServed) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can be somebody else for a moment";
  const auto port = ports.open(pty.path());
  EXPECT_EQ(as_another_user([&] {
              const HolderConnection served = connect_to(key(), seconds(1));
              return served.connection ? 1 : 0;
            }),
            0);
  EXPECT_TRUE(somebody_listens()) << "and its own user's are";
}

TEST_F(SharedPortOfTheSystem, ANameThatAProgramOfAnotherUserHoldsIsSaidAndNotBelieved) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can be somebody else for a moment";
  int ready[2], done[2];
  ASSERT_EQ(::pipe(ready) + ::pipe(done), 0);
  const pid_t stranger = ::fork();
  if (stranger == 0) {
    char byte = 0;
    ::close(done[1]);
    if (::setuid(65'534) != 0) ::_exit(1);
    const Descriptor listener = listen_at(key());
    ::_exit(::write(ready[1], "x", 1) == 1 && ::read(done[0], &byte, 1) == 0 ? 0 : 1);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  Remark said;
  {
    const auto port = ports.open(pty.path(), kDefaultBaud, [&](const Remark& remark) { said = remark; });
    EXPECT_THAT(said, Tells(SharingProblem::not_shared, pty.path()));
  }
  for (const int end : {ready[0], ready[1], done[0], done[1]}) ::close(end);
  ::waitpid(stranger, nullptr, 0);
}

TEST_F(SharedPortOfTheSystem, IsFoundWhateverTheEnvironmentSays) {
  const ServedRobot robot(pty.master());
  ::setenv("XDG_RUNTIME_DIR", "/nonexistent", 1);
  Client first(ports.open(pty.path()));
  first.connect();
  ::unsetenv("XDG_RUNTIME_DIR");
  Client second(ports.open(pty.path()));
  EXPECT_EQ(second.connect().robot_name.view(), "astro");
}

TEST_F(SharedPortOfTheSystem, TheSocketGoesWithTheProgram) {
  {
    const auto port = ports.open(pty.path());
    EXPECT_TRUE(somebody_listens());
  }
  // The check was a connection, for which the port is served until its end is noticed.
  const auto end = std::chrono::steady_clock::now() + seconds(10);
  while (somebody_listens() && std::chrono::steady_clock::now() < end) ::usleep(20'000);
  EXPECT_FALSE(somebody_listens());
}

TEST_F(SharedPortOfTheSystem, AGuestThatIsTurnedAwayReadsWhyThoughItGoesOnWriting) {
  const ServedRobot robot(pty.master());
  Client first(ports.open(pty.path()));
  first.connect();
  std::vector<std::unique_ptr<Client>> many;
  for (int i = 0; i < 32; ++i) {
    many.push_back(std::make_unique<Client>(ports.open(pty.path())));
    many.back()->connect();
    many.back()->request(protocol::SetTelemetry{1000, protocol::Telemetry::kPose});
  }
  Client last(ports.open(pty.path()));
  last.connect();
  EXPECT_THAT(
      [&] {
        last.request(protocol::SetTelemetry{1000, protocol::Telemetry::kPose});
      },
      ThrowsTelling<LinkLost>(FarewellReason::too_many, pty.path()))
      << "there is no place left";
}

TEST_F(SharedPortOfTheSystem, AnExclusiveHolderIsSaidToUseThePort) {
  const auto exclusive = open_transport(pty.path());
  EXPECT_THAT(why_not(), Tells(PortProblem::in_use, pty.path()));
}

TEST_F(SharedPortOfTheSystem, ALostLineIsALostLinkForEverybody) {
  ServedRobot robot(pty.master());
  Client first(ports.open(pty.path()));
  first.connect();
  Client second(ports.open(pty.path()));
  second.connect();
  robot.end();
  pty.hang_up();
  for (Client* client : {&first, &second})
    EXPECT_THAT([&] { client->pump(seconds(5)); },
                ThrowsTelling<LinkLost>(FarewellReason::line_lost, pty.path()));
}

TEST_F(SharedPortOfTheSystem, AKilledHolderIsNamedAndItsPlaceTaken) {
  const ServedRobot robot(pty.master());
  const pid_t holder = holder_in_a_child();
  Client client(ports.open(pty.path()));
  client.connect();
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
  EXPECT_THAT([&] { client.pump(seconds(5)); },
              ThrowsTelling<LinkLost>(SharingProblem::holder_ended, pty.path(), std::to_string(holder)));
  client.reconnect(seconds(5));
  EXPECT_EQ(client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
  Client next(ports.open(pty.path()));
  next.connect();
}

TEST_F(SharedPortOfTheSystem, AStoppedHolderIsNamedWithinBoundedTime) {
  const ServedRobot robot(pty.master());
  const pid_t holder = holder_in_a_child();
  Client client(ports.open(pty.path()));
  client.connect();
  ::kill(holder, SIGSTOP);
  ::waitpid(holder, nullptr, WUNTRACED);
  const std::string named = std::to_string(holder);
  const RetryPolicy hasty{.timeout = milliseconds(20), .tries = 3};
  EXPECT_THAT([&] { client.request(protocol::GetStatus{}, hasty); },
              ThrowsTelling<LinkLost>(SharingProblem::holder_hangs, named));
  EXPECT_THAT(why_not(), Tells(SharingProblem::holder_hangs, named)) << "a program that comes later";
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
}

TEST_F(SharedPortOfTheSystem, AHolderThatEndsLeavesTheOthersTheirPort) {
  const ServedRobot robot(pty.master());
  std::optional<Client> first(ports.open(pty.path()));
  first->connect();
  Client second(ports.open(pty.path()));
  second.connect();
  first.reset();
  EXPECT_EQ(second.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed) << "while it still runs";
  ports.leave_to_others();
  EXPECT_EQ(second.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
  Client third(ports.open(pty.path()));
  EXPECT_EQ(third.connect().robot_name.view(), "astro") << "still served";
}

TEST_F(SharedPortOfTheSystem, AServerThatIsMerelyDestroyedTellsItsGuestsAndLeavesNoProcessBehind) {
  const ServedRobot robot(pty.master());
  std::optional<RelayServer> server(SharedLine{open_line(pty.path(), kDefaultBaud), listen_at(key())});
  Client guest(ports.open(pty.path()));
  guest.connect();
  server.reset();
  EXPECT_TRUE(is_free()) << "although the guest has not gone";
  EXPECT_FALSE(somebody_listens());
  try {
    guest.pump(seconds(5));
    FAIL();
  } catch (const LinkLost& lost) {
    EXPECT_EQ(lost.what(), "lost " + pty.path() + ": the program that held the port has ended");
  }
}

TEST_F(SharedPortOfTheSystem, WhatServesTheOthersEndsWithTheLastOfThem) {
  const ServedRobot robot(pty.master());
  for (const bool program_ends : {false, true}) {
    {
      std::optional<Client> first(ports.open(pty.path()));
      first->connect();
      Client second(ports.open(pty.path()));
      second.connect();
      first.reset();
      if (program_ends) ports.leave_to_others();
      second.request(protocol::GetStatus{});
      EXPECT_FALSE(is_free());
    }
    const auto end = std::chrono::steady_clock::now() + seconds(10);
    while (!is_free() && std::chrono::steady_clock::now() < end) ::usleep(2000);
    EXPECT_TRUE(is_free());
    EXPECT_FALSE(somebody_listens());
  }
}

TEST_F(SharedPortOfTheSystem, ALoopbackAddressIsSharedLikeAPort) {
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* any = reinterpret_cast<sockaddr*>(&address);
  ASSERT_EQ(::bind(listener, any, size), 0);
  ASSERT_EQ(::listen(listener, 1), 0);
  ASSERT_EQ(::getsockname(listener, any, &size), 0);
  const std::string name = ":" + std::to_string(ntohs(address.sin_port));
  {
    ServedRobot robot = ServedRobot::accepting(listener);
    Client first(ports.open("tcp:localhost" + name));
    first.connect();
    Client second(ports.open("tcp:127.0.0.1" + name));  // another name of the same
    EXPECT_EQ(second.connect().robot_name.view(), "astro");
    EXPECT_EQ(second.request(protocol::GetParameterInfo{2}).name.view(), "b");
    robot.end();
    EXPECT_THROW(second.pump(seconds(5)), LinkLost);
  }
  ::close(listener);
}

}  // namespace
}  // namespace astro::robot
