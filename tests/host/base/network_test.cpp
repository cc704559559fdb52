#include "host/base/network.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <array>

#include "tests/support/base/remarks.hpp"

// Sockets that never wait, over loopback.
namespace astro::net {
namespace {

using boost::asio::io_context;
using boost::asio::ip::address_v4;
using boost::asio::ip::address_v6;
using std::chrono::milliseconds;
using std::chrono::seconds;

const tcp::endpoint kAnyPort(address_v4::loopback(), 0);

Connecting outcome(io_context& io, const Attempt& attempt) {
  for (int i = 0; i < 100 && *attempt.state == Connecting::pending; ++i) wait_to_read(io, milliseconds(100));
  return *attempt.state;
}

TEST(Network, AnAttemptToConnectSucceedsWhereSomebodyListensAndFailsElsewhere) {
  io_context io;
  tcp::acceptor listener = listen_tcp(io, kAnyPort);
  const tcp::endpoint at = listener.local_endpoint();
  auto attempt = begin_tcp(io, at);
  EXPECT_EQ(*attempt->state, Connecting::pending);
  EXPECT_EQ(outcome(io, *attempt), Connecting::connected);
  EXPECT_TRUE(accept_tcp(listener));
  EXPECT_FALSE(accept_tcp(listener)) << "it does not wait for another one";
  listener.close();
  EXPECT_EQ(outcome(io, *begin_tcp(io, at)), Connecting::failed);
}

TEST(Network, AnAttemptThatIsGivenUpFailsWithoutItsSocket) {
  io_context io;
  tcp::acceptor listener = listen_tcp(io, kAnyPort);
  auto attempt = begin_tcp(io, listener.local_endpoint());
  const auto state = attempt->state;
  attempt.reset();
  io.poll();
  EXPECT_EQ(*state, Connecting::failed);
}

TEST(Network, AConnectionTellsWhatWaitsFromItsEnd) {
  io_context io;
  tcp::acceptor listener = listen_tcp(io, kAnyPort);
  tcp::socket client(io);
  client.connect(listener.local_endpoint());
  auto accepted = accept_tcp(listener);
  EXPECT_EQ(accepted->from, client.local_endpoint());
  std::array<std::uint8_t, 8> buffer{};
  EXPECT_TRUE(receive(accepted->socket, buffer)->empty());
  EXPECT_FALSE(wait_to_read(io, milliseconds(1), accepted->socket));
  send(client, as_bytes("abc"));
  ASSERT_TRUE(wait_to_read(io, seconds(10), accepted->socket));
  EXPECT_EQ(as_text(*receive(accepted->socket, buffer)), "abc");
  client.close();
  ASSERT_TRUE(wait_to_read(io, seconds(10), accepted->socket));
  EXPECT_FALSE(receive(accepted->socket, buffer));
}

TEST(Network, NoSocketGoesToAChildProcess) {
  io_context io;
  tcp::acceptor listener = listen_tcp(io, kAnyPort);
  auto attempt = begin_tcp(io, listener.local_endpoint());
  ASSERT_EQ(outcome(io, *attempt), Connecting::connected);
  auto accepted = accept_tcp(listener);
  udp::socket datagrams = bind_udp(io, {address_v4::loopback(), 0});
  for (const int socket : {listener.native_handle(), attempt->socket.native_handle(),
                           accepted->socket.native_handle(), datagrams.native_handle()})
    EXPECT_EQ(::fcntl(socket, F_GETFD), FD_CLOEXEC);
}

TEST(Network, AGroupOfIpv4IsNotJoinedAtAnAddressOfIpv6) {
  io_context io;
  EXPECT_THROW(join_multicast(io, {address_v4({239, 255, 42, 99}), 0}, address_v6::loopback()), Error);
  EXPECT_THROW(join_multicast(io, {boost::asio::ip::make_address("ff02::1"), 0}, address_v4::loopback()),
               Error);
}

/// Lowers the limit of open files to those that are open.
class NoFreeDescriptor {
 public:
  NoFreeDescriptor() {
    getrlimit(RLIMIT_NOFILE, &before_);
    rlimit none = before_;
    none.rlim_cur = 0;
    setrlimit(RLIMIT_NOFILE, &none);
  }
  NoFreeDescriptor(const NoFreeDescriptor&) = delete;
  NoFreeDescriptor& operator=(const NoFreeDescriptor&) = delete;
  ~NoFreeDescriptor() { setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

TEST(Network, WithoutAFreeDescriptorNothingIsWrongWithTheAddress) {
#ifdef ASTRO_SANITIZE
  GTEST_SKIP() << "the sanitizer's checks of types need descriptors of their own";
#endif
  io_context fresh, in_use;
  const udp::socket socket = bind_udp(in_use, {address_v4::loopback(), 0});
  const std::string why =
      "no socket can be opened: this program has as many files open as its limit allows, 0";
  for (io_context* io : {&fresh, &in_use}) {
    const auto told = [&](auto work) {
      const NoFreeDescriptor none;
      return support::told_by(work);
    };
    const udp::endpoint at(address_v4::loopback(), 0);
    EXPECT_EQ(told([&] { begin_tcp(*io, kAnyPort); }).sentence, why);
    EXPECT_EQ(told([&] { listen_tcp(*io, kAnyPort); }).sentence, why);
    EXPECT_EQ(told([&] { bind_udp(*io, at); }).sentence, why);
    EXPECT_EQ(told([&] { connect_udp(*io, at); }).sentence, why);
    EXPECT_EQ(told([&] { bind_udp(*io, at); }).kind, Kind()) << "no other port would help";
  }
}

}  // namespace
}  // namespace astro::net
