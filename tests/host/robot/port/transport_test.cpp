#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>

#include "host/robot/client/client.hpp"
#include "host/robot/port/open_transport.hpp"
#include "host/robot/port/serial_port.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/links/pty.hpp"
#include "tests/support/programs/served_robot.hpp"

namespace astro::robot {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using support::Tells;
using test::Pty;
using test::ServedRobot;
using test::TemporaryFolder;
using Bytes = std::vector<std::uint8_t>;

Remark refusal(const std::string& address) {
  return support::told_by([&] { open_transport(address); });
}

/// Reads `size` bytes, or fewer if they do not arrive within 2 s.
Bytes read_all(Transport& transport, std::size_t size) {
  Bytes bytes(size);
  std::size_t have = 0;
  const auto deadline = transport.now() + seconds(2);
  while (have < size && transport.now() < deadline) {
    have += transport.read(std::span(bytes).subspan(have), deadline - transport.now());
  }
  bytes.resize(have);
  return bytes;
}

Bytes every_byte() {
  Bytes bytes(256);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i);
  return bytes;
}

TEST(SerialTransport, CarriesEveryByteBothWays) {
  const Pty pty;
  const auto transport = open_transport(pty.path());
  const Bytes sent = every_byte();
  ASSERT_EQ(::write(pty.master(), sent.data(), sent.size()), 256);
  EXPECT_EQ(read_all(*transport, sent.size()), sent);
  transport->write(sent);
  Bytes received(sent.size());
  std::size_t have = 0;
  while (have < received.size()) {
    const auto size = ::read(pty.master(), received.data() + have, received.size() - have);
    ASSERT_GT(size, 0);
    have += static_cast<std::size_t>(size);
  }
  EXPECT_EQ(received, sent);
}

TEST(SerialTransport, WaitsAsLongAsItIsTold) {
  const Pty pty;
  const auto transport = open_transport(pty.path());
  std::array<std::uint8_t, 8> into;
  const auto start = transport->now();
  EXPECT_EQ(transport->read(into, milliseconds(0)), 0U);
  EXPECT_EQ(transport->read(into, milliseconds(30)), 0U);
  EXPECT_GE(transport->now() - start, milliseconds(30));
}

/// Lets a read time out at another stack depth, where `below` bytes cover what the last time-out left on the
/// stack. Returns whether those bytes are unchanged.
[[gnu::noinline]] bool time_out_above_a_pattern(Transport& transport) {
  std::array<volatile std::uint8_t, 4096> below;
  for (volatile std::uint8_t& byte : below) byte = 0xA5;
  std::array<std::uint8_t, 8> into;
  EXPECT_EQ(transport.read(into, milliseconds(5)), 0U);
  return std::all_of(below.begin(), below.end(), [](std::uint8_t byte) { return byte == 0xA5; });
}

TEST(SerialTransport, ATimeOutLeavesNothingBehindThatALaterOneWouldRun) {
  const Pty pty;
  const auto transport = open_transport(pty.path());
  std::array<std::uint8_t, 8> into;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(transport->read(into, milliseconds(5)), 0U);
    EXPECT_TRUE(time_out_above_a_pattern(*transport)) << "the last wait wrote where it had ended";
  }
  ASSERT_EQ(::write(pty.master(), "x", 1), 1);
  EXPECT_EQ(transport->read(into, seconds(2)), 1U);
}

TEST(SerialTransport, TakesAnyBaudRateAndAnyLinkToAPort) {
  const TemporaryFolder folder;
  const Pty pty;
  std::filesystem::create_symlink(pty.path(), folder.path() / "robot.pty");
  for (const unsigned baud : {9600U, 115200U, 250000U, 1'234'567U}) {
    EXPECT_NO_THROW(open_transport(folder.path() / "robot.pty", baud)) << baud;
  }
}

TEST(SerialTransport, IsSharedWithNobodyAndFreeAgainAtTheEnd) {
  const Pty pty;
  {
    const auto first = open_transport(pty.path());
    EXPECT_THAT(refusal(pty.path()), Tells(PortProblem::in_use, pty.path()));
  }
  EXPECT_NO_THROW(open_transport(pty.path()));
}

TEST(SerialTransport, AHangUpIsALostLinkForReadAndWrite) {
  Pty pty;
  const auto transport = open_transport(pty.path());
  pty.hang_up();
  std::array<std::uint8_t, 8> into;
  EXPECT_THROW(transport->read(into, seconds(2)), LinkLost);
  EXPECT_THROW(transport->write(into), LinkLost);
  EXPECT_THROW(transport->reopen(milliseconds(1)), Error);
}

TEST(SerialTransport, SaysWhatIsWrongWithAnAddress) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "notes.txt";
  std::ofstream(file) << "no port\n";
  const std::string nothing = folder.path() / "nothing";
  EXPECT_THAT(refusal(nothing), Tells(PortProblem::absent, nothing));
  EXPECT_THAT(refusal(file), Tells(PortProblem::not_serial, file));
  EXPECT_THAT(refusal(folder.path()), Tells(PortProblem::is_folder, folder.path().string()));
  EXPECT_THAT(refusal("/dev/null"), Tells(PortProblem::not_serial, "/dev/null"));
  EXPECT_THAT(refusal(""), Tells(PortProblem::none_named));
  if (::geteuid() == 0) return;  // root may open anything
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_THAT(refusal(file), Tells(PortProblem::no_permission, file));
}

TEST(SerialTransport, LeavesTheTerminalOfAShellAlone) {
  const Pty pty;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t shell = ::fork();
  if (shell == 0) {
    ::setsid();
    const int terminal = ::open(pty.path().c_str(), O_RDWR);  // becomes the controlling one
    const char byte = terminal >= 0 ? 1 : 0;
    if (::write(ready[1], &byte, 1) == 1) ::pause();
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_THAT(refusal(pty.path()), Tells(PortProblem::is_terminal, pty.path()));
  ::kill(shell, SIGKILL);
  ::waitpid(shell, nullptr, 0);
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(SerialTransport, ClientTalksToARobotOverAPty) {
  const Pty pty;
  const ServedRobot robot(pty.master());
  Client client(open_transport(pty.path()));
  EXPECT_EQ(client.connect().robot_name.view(), "astro");
  EXPECT_EQ(client.request(protocol::GetParameterInfo{2}).name.view(), "b");
}

TEST(SerialTransport, ReconnectsToARobotThatComesBackUnderTheSameName) {
  const TemporaryFolder folder;
  const auto link = folder.path() / "robot.pty";
  std::optional<Pty> pty(std::in_place);
  std::filesystem::create_symlink(pty->path(), link);
  ServedRobot robot(pty->master());
  Client client(open_transport(link));
  client.connect();
  robot.end();
  pty.reset();
  EXPECT_THROW(client.pump(seconds(5)), LinkLost);

  pty.emplace();
  std::filesystem::remove(link);
  std::filesystem::create_symlink(pty->path(), link);
  const ServedRobot again(pty->master());
  client.reconnect(seconds(5));
  EXPECT_EQ(client.request(protocol::GetStatus{}).mode, protocol::Mode::disarmed);
}

/// A socket that listens at a loopback port of the system's choice.
class Listener {
 public:
  Listener() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* any = reinterpret_cast<sockaddr*>(&address);
    if (::bind(socket_, any, size) != 0 || ::listen(socket_, 1) != 0)
      throw std::runtime_error("cannot listen");
    ::getsockname(socket_, any, &size);
    port_ = ntohs(address.sin_port);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() { close(); }
  int accept() const { return ::accept(socket_, nullptr, nullptr); }
  void close() {
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  }
  std::string address(const std::string& host) const { return "tcp:" + host + ":" + std::to_string(port_); }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

TEST(TcpTransport, ClientTalksToARobotOnThisMachine) {
  for (const std::string host : {"localhost", "127.0.0.1"}) {
    const Listener listener;
    auto transport = open_transport(listener.address(host));
    const int connection = listener.accept();
    {
      const ServedRobot robot(connection);
      Client client(*transport);
      EXPECT_EQ(client.connect().robot_name.view(), "astro");
    }
    ::close(connection);
    std::array<std::uint8_t, 8> into;
    EXPECT_THROW(transport->read(into, seconds(2)), LinkLost);
  }
}

TEST(TcpTransport, SaysWhatIsWrongWithAnAddress) {
  Listener listener;
  const std::string dead = listener.address("127.0.0.1");
  listener.close();
  EXPECT_THAT(refusal(dead), Tells(PortProblem::nobody_listens, dead));
  for (const std::string far : {"tcp:192.0.2.1:5555", "tcp:robot.example:5555"})
    EXPECT_THAT(refusal(far), Tells(PortProblem::not_local, far));
  for (const std::string bad : {"tcp:", "tcp:5555", "tcp:localhost:", "tcp:localhost:x",
                                "tcp:localhost:70000", "tcp::5555", "tcp:localhost:0", "tcp:localhost:5x"}) {
    EXPECT_THAT(refusal(bad), Tells(PortProblem::no_address, bad));
  }
}

}  // namespace
}  // namespace astro::robot
