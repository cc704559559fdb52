#include "host/truth/live/socket_source.hpp"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "host/base/error.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::truth {
namespace {

using support::Tells;
using testing::IsEmpty;
using testing::SizeIs;

/// The peer of a socket, which sends what a test needs.
class Cameras {
 public:
  Cameras() {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path().c_str(), sizeof(address.sun_path) - 1);
    bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
    listen(listener_, 1);
  }
  ~Cameras() {
    hang_up();
    close(listener_);
  }
  std::filesystem::path path() const { return folder_.path() / "robot.pty.mocap"; }
  void send(std::string_view text) {
    if (client_ < 0) client_ = accept(listener_, nullptr, nullptr);
    EXPECT_EQ(::send(client_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  void hang_up() {
    if (client_ >= 0) close(client_);
    client_ = -1;
  }

 private:
  test::TemporaryFolder folder_;
  int listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  int client_ = -1;
};

constexpr const char* kGreeting = "astrolabe-mocap 1\n";

Remark failure_of(SocketSource& source) {
  return support::told_by([&] { source.poll(); });
}

class Socket : public testing::Test {
 protected:
  Cameras cameras;
  SocketSource source{cameras.path()};
};

TEST_F(Socket, GivesEachLineAsAPose) {
  cameras.send(kGreeting);
  cameras.send("1000 1.5 -2.25 0.125 1\n17667 1e-3 0 -7.5 0\n");
  const auto samples = source.poll();
  ASSERT_THAT(samples, SizeIs(2));
  EXPECT_EQ(samples[0].time_us, 1000);
  EXPECT_EQ(samples[0].x_m, 1.5);
  EXPECT_EQ(samples[0].y_m, -2.25);
  EXPECT_EQ(samples[0].theta_rad, 0.125);
  EXPECT_TRUE(samples[0].valid);
  EXPECT_EQ(samples[1].x_m, 0.001);
  EXPECT_EQ(samples[1].theta_rad, -7.5);  // continuous: not wrapped
  EXPECT_FALSE(samples[1].valid);
  EXPECT_THAT(source.poll(), IsEmpty());
}

TEST_F(Socket, PutsLinesTogetherHoweverTheyAreCut) {
  const std::string text = std::string(kGreeting) + "1000 1.5 -2.25 0.125 1\n2000 2.5 0 0 1\n";
  std::size_t samples = 0;
  for (const char byte : text) {
    cameras.send({&byte, 1});
    samples += source.poll().size();
  }
  EXPECT_EQ(samples, 2U);
}

TEST_F(Socket, NeverWaits) { EXPECT_THAT(source.poll(), IsEmpty()); }

TEST_F(Socket, SaysThatALineIsNoPose) {
  for (const char* bad : {"", "1000", "1000 1 2 3", "1000 1 2 three 1", "x 1 2 3 1"}) {
    Cameras others;
    SocketSource damaged(others.path());
    others.send(kGreeting);
    others.send(std::string(bad) + "\n");
    EXPECT_THAT(failure_of(damaged), Tells(SocketProblem::no_pose, others.path().string())) << bad;
  }
}

TEST_F(Socket, DoesNotTakeAnotherProgramForASimulator) {
  cameras.send("HTTP/1.1 400 Bad Request\r\n");
  EXPECT_THAT(failure_of(source), Tells(SocketProblem::of_other_version, cameras.path().string()));
}

TEST_F(Socket, DoesNotTakeAnotherVersionForThisOne) {
  cameras.send("astrolabe-mocap 2\n");
  EXPECT_THAT(failure_of(source), Tells(SocketProblem::of_other_version, cameras.path().string()));
}

TEST_F(Socket, SaysThatTheCamerasHaveGone) {
  cameras.send(kGreeting);
  EXPECT_THAT(source.poll(), IsEmpty());
  cameras.hang_up();
  EXPECT_THAT(failure_of(source), Tells(SocketProblem::disconnected, cameras.path().string()));
}

TEST(NoSocket, SaysThatASimulatorIsNeeded) {
  EXPECT_THAT([] { SocketSource{"/no/such.mocap"}; },
              support::ThrowsTelling(SocketProblem::not_served, "/no/such.mocap"));
}

TEST(MocapSocket, IsBesideThePtyAlsoWhenThePortIsALinkToIt) {
  namespace fs = std::filesystem;
  const test::TemporaryFolder folder;
  const fs::path pty = folder.path() / "robot.pty";
  fs::create_symlink("/dev/null", pty);  // what a simulator makes: a link to a device, and a socket beside it
  const Cameras cameras;
  fs::create_symlink(cameras.path(), pty.string() + ".mocap");
  fs::create_symlink("robot.pty", folder.path() / "near");  // relative
  fs::create_symlink(folder.path() / "near", folder.path() / "far");
  for (const char* name : {"robot.pty", "near", "far"})
    EXPECT_EQ(mocap_socket_of(folder.path() / name), pty.string() + ".mocap") << name;
}

TEST(MocapSocket, EndsWithLinksInACircle) {
  namespace fs = std::filesystem;
  const test::TemporaryFolder folder;
  fs::create_symlink(folder.path() / "b", folder.path() / "a");
  fs::create_symlink(folder.path() / "a", folder.path() / "b");
  EXPECT_EQ(mocap_socket_of(folder.path() / "a"), (folder.path() / "a").string() + ".mocap");
}

TEST(SocketSource, ALineWithoutAnEndIsNotWaitedFor) {
  Cameras cameras;
  SocketSource source(cameras.path());
  cameras.send("astrolabe-mocap 1\n" + std::string(2000, '1'));
  EXPECT_THAT(failure_of(source), Tells(SocketProblem::no_pose, cameras.path().string()))
      << "a line of 2000 bytes without an end was kept";
}

}  // namespace
}  // namespace astro::truth
