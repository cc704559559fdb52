#include "host/link/shared_port.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <filesystem>
#include <optional>

#include "host/link/client.hpp"
#include "host/link/port_socket.hpp"
#include "host/link/ports.hpp"
#include "host/link/serial_port.hpp"
#include "tests/support/pty.hpp"
#include "tests/support/served_robot.hpp"
#include "tests/support/temporary_folder.hpp"

// One port and several programs, as far as only an operating system can show it: the other programs are
// connections of this process, and children where a program has to die.
namespace astro::link {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test::Pty;
using test::ServedRobot;
using testing::HasSubstr;

/// A runtime folder of this test's own.
class SharedPortOfTheSystem : public testing::Test {
 protected:
  SharedPortOfTheSystem() { ::setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1); }
  ~SharedPortOfTheSystem() override { ::unsetenv("XDG_RUNTIME_DIR"); }

  fs::path socket() const {
    struct stat about {};
    ::stat(pty.path().c_str(), &about);
    return socket_of(port_key(about.st_rdev));
  }

  std::string why_not() const {
    try {
      open_shared_port(pty.path());
    } catch (const Error& error) {
      return error.what();
    }
    return "opened";
  }

  /// A child that holds the port, says so and waits for its end.
  pid_t holder_in_a_child() {
    int ready[2];
    if (::pipe(ready) != 0) throw std::runtime_error("no pipe");
    const pid_t child = ::fork();
    if (child == 0) {
      const auto transport = open_shared_port(pty.path());
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

 private:
  test::TemporaryFolder folder_;
};

TEST_F(SharedPortOfTheSystem, TheSecondProgramWorksAsIfItHadThePort) {
  const ServedRobot robot(pty.master());
  Client first(open_shared_port(pty.path()));
  first.connect();
  Client second(open_shared_port(pty.path()));
  EXPECT_EQ(second.connect().robot_name.view(), "astro");
  EXPECT_EQ(second.request(protocol::GetParameterInfo{2}).name.view(), "b");
  EXPECT_EQ(first.request(protocol::GetParameterInfo{0}).name.view(), "c_R");
  EXPECT_EQ(second.name(), pty.path());
}

TEST_F(SharedPortOfTheSystem, SocketAndFolderArePrivateToTheUser) {
  fs::create_directory(runtime_folder());
  fs::permissions(runtime_folder(), fs::perms::all);  // left open by whoever made it
  const auto port = open_shared_port(pty.path());
  EXPECT_EQ(fs::status(socket()).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(fs::status(runtime_folder()).permissions(), fs::perms::owner_all);
}

TEST_F(SharedPortOfTheSystem, TheSocketGoesWithTheProgram) {
  {
    const auto port = open_shared_port(pty.path());
    EXPECT_TRUE(fs::exists(socket()));
  }
  EXPECT_FALSE(fs::exists(socket()));
  EXPECT_TRUE(fs::is_empty(runtime_folder()));
}

TEST_F(SharedPortOfTheSystem, DeadSocketsOfOtherPortsAreSweptAndLiveOnesAreNot) {
  make_runtime_folder();
  const auto dead = socket_of("port-9-9"), live = socket_of("port-9-8");
  listen_at(dead);  // and ended without taking it away
  const Descriptor listener = listen_at(live);
  ASSERT_FALSE(fs::exists(dead)) << "swept by the next that listens";
  listen_at(dead);
  ASSERT_TRUE(fs::exists(dead));
  const auto port = open_shared_port(pty.path());
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(live));
}

TEST_F(SharedPortOfTheSystem, AnExclusiveHolderIsSaidToUseThePort) {
  const auto exclusive = open_transport(pty.path());
  EXPECT_THAT(why_not(), HasSubstr(pty.path() + " is in use by another program"));
}

TEST_F(SharedPortOfTheSystem, ALostLineIsALostLinkForEverybody) {
  std::optional<ServedRobot> robot(std::in_place, pty.master());
  Client first(open_shared_port(pty.path()));
  first.connect();
  Client second(open_shared_port(pty.path()));
  second.connect();
  robot.reset();
  pty.hang_up();
  for (Client* client : {&first, &second}) {
    try {
      client->pump(seconds(5));
      FAIL();
    } catch (const LinkLost& lost) {
      EXPECT_THAT(lost.what(), HasSubstr("lost " + pty.path() + ": it was unplugged, switched off or ended"));
    }
  }
}

TEST_F(SharedPortOfTheSystem, AKilledHolderIsNamedAndItsPlaceTaken) {
  const ServedRobot robot(pty.master());
  const pid_t holder = holder_in_a_child();
  Client client(open_shared_port(pty.path()));
  client.connect();
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
  try {
    client.pump(seconds(5));
    FAIL();
  } catch (const LinkLost& lost) {
    EXPECT_THAT(lost.what(),
                HasSubstr("the program that held the port (process id " + std::to_string(holder)));
    EXPECT_THAT(lost.what(), HasSubstr("has ended"));
  }
  EXPECT_TRUE(fs::exists(socket())) << "left behind";
  client.reconnect(seconds(5));
  EXPECT_EQ(client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
  Client next(open_shared_port(pty.path()));
  next.connect();
}

TEST_F(SharedPortOfTheSystem, AStoppedHolderIsNamedWithinBoundedTime) {
  const ServedRobot robot(pty.master());
  const pid_t holder = holder_in_a_child();
  Client client(open_shared_port(pty.path()));
  client.connect();
  ::kill(holder, SIGSTOP);
  ::waitpid(holder, nullptr, WUNTRACED);
  const std::string named = "the program with process id " + std::to_string(holder);
  try {
    client.request(protocol::GetStatus{}, {.timeout = milliseconds(20), .tries = 3});
    ADD_FAILURE() << "answered";
  } catch (const LinkLost& lost) {
    EXPECT_THAT(lost.what(), HasSubstr(named));
    EXPECT_THAT(lost.what(), HasSubstr("holds the port and does not answer"));
  }
  EXPECT_THAT(why_not(), HasSubstr(named)) << "a program that comes later";
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
}

TEST_F(SharedPortOfTheSystem, AHolderThatEndsLeavesTheOthersTheirPort) {
  const ServedRobot robot(pty.master());
  std::optional<Client> first(open_shared_port(pty.path()));
  first->connect();
  Client second(open_shared_port(pty.path()));
  second.connect();
  first.reset();
  EXPECT_EQ(second.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
  Client third(open_shared_port(pty.path()));
  EXPECT_EQ(third.connect().robot_name.view(), "astro") << "still served";
}

TEST_F(SharedPortOfTheSystem, WhatServesTheOthersEndsWithTheLastOfThem) {
  const ServedRobot robot(pty.master());
  {
    std::optional<Client> first(open_shared_port(pty.path()));
    first->connect();
    Client second(open_shared_port(pty.path()));
    second.connect();
    first.reset();
    second.request(protocol::GetStatus{});
  }
  const auto free = [&] {
    try {
      open_transport(pty.path());
    } catch (const Error&) {
      return false;
    }
    return true;
  };
  const auto end = std::chrono::steady_clock::now() + seconds(10);
  while (!free() && std::chrono::steady_clock::now() < end) ::usleep(2000);
  EXPECT_TRUE(free());
  EXPECT_FALSE(fs::exists(socket()));
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
    Client first(open_shared_port("tcp:localhost" + name));
    const int connection = ::accept(listener, nullptr, nullptr);
    const ServedRobot robot(connection);
    first.connect();
    Client second(open_shared_port("tcp:127.0.0.1" + name));  // another name of the same
    EXPECT_EQ(second.connect().robot_name.view(), "astro");
    EXPECT_EQ(second.request(protocol::GetParameterInfo{2}).name.view(), "b");
    ::shutdown(connection, SHUT_RDWR);
    EXPECT_THROW(second.pump(seconds(5)), LinkLost);
  }
  ::close(listener);
}

TEST_F(SharedPortOfTheSystem, ALongRuntimeFolderIsNoHindrance) {
  // A socket's address has room for 107 characters.
  const fs::path deep = fs::path(std::getenv("XDG_RUNTIME_DIR")) / std::string(120, 'x');
  fs::create_directory(deep);
  ::setenv("XDG_RUNTIME_DIR", deep.c_str(), 1);
  const ServedRobot robot(pty.master());
  Client first(open_shared_port(pty.path()));
  first.connect();
  Client second(open_shared_port(pty.path()));
  second.connect();
}

}  // namespace
}  // namespace astro::link
