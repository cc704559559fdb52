#include "host/truth/live/vrpn_link.hpp"

#include <gmock/gmock.h>

#include <array>
#include <charconv>
#include <optional>

#include "host/base/network.hpp"
#include "host/truth/trackers/vrpn_tracker.hpp"
#include "tests/support/base/remarks.hpp"

// The client's side of a connection, over loopback and in virtual time.
namespace astro::truth {
namespace {

using net::address_v4;
using std::chrono::microseconds;
using std::chrono::milliseconds;

net::tcp::acceptor listen(net::io_context& io) { return net::listen_tcp(io, {address_v4::loopback(), 0}); }

/// A port of this computer that nobody listens to.
std::uint16_t free_port() {
  net::io_context io;
  return listen(io).local_endpoint().port();
}

TrackerUrl url_of(std::uint16_t port) {
  return tracker_url_in("vrpn://127.0.0.1:" + std::to_string(port) + "/ASTRO");
}

Bytes greeting_and_pose() {
  Bytes bytes = vrpn::cookie();
  vrpn::append_description(bytes, vrpn::kSenderDescription, 1, "ASTRO", 0);
  vrpn::append_description(bytes, vrpn::kTypeDescription, 2, vrpn::kPoseType, 0);
  const Bytes payload = vrpn::payload_of({});
  vrpn::append(bytes, {7, 1, 2, 0, payload});
  return bytes;
}

/// Lets the client work for up to ten virtual seconds, until `done`.
template <class Done>
bool work_until(VrpnLink& link, microseconds& now, Done done) {
  for (int i = 0; i < 200; ++i, now += milliseconds(50)) {
    if (done()) return true;
    link.work(now);
    link.wait(milliseconds(1));
  }
  return false;
}

TEST(VrpnLink, AsksByUdpToBeCalledBackWhereNothingAnswersByTcp) {
  const std::uint16_t port = free_port();
  net::io_context io;
  net::udp::socket server = net::bind_udp(io, {address_v4::loopback(), port});
  VrpnLink link(url_of(port));
  microseconds now{0};
  std::array<std::uint8_t, 256> buffer{};
  std::optional<net::Datagram> asked;
  ASSERT_TRUE(
      work_until(link, now, [&] { return (asked = net::receive_datagram(server, buffer)).has_value(); }));
  const std::string request(as_text(asked->bytes));
  ASSERT_TRUE(request.starts_with("127.0.0.1 ")) << request;
  EXPECT_EQ(request.back(), '\0');
  std::uint16_t call_port = 0;
  std::from_chars(request.data() + 10, request.data() + request.size(), call_port);
  net::tcp::socket call(io);
  call.connect({asked->from.address(), call_port});
  net::send(call, greeting_and_pose());
  std::vector<Sighting> sightings;
  EXPECT_TRUE(work_until(link, now, [&] {
    for (const Sighting& sighting : link.take()) sightings.push_back(sighting);
    return !sightings.empty();
  }));
  EXPECT_EQ(link.way(), "by a call back over TCP");
  Bytes cookie(vrpn::kCookieBytes);
  ASSERT_TRUE(net::wait_to_read(io, milliseconds(1000), call));
  net::receive(call, cookie);
  EXPECT_EQ(cookie, vrpn::cookie());
}

/// Two addresses of one host; a test's server serves at the last of them only.
std::vector<net::address> two_addresses() {
  return {boost::asio::ip::make_address("127.0.0.2"), address_v4::loopback()};
}

TEST(VrpnLink, TriesEachAddressOfTheHostByTcpAndThenByACallBack) {
  net::io_context io;
  net::tcp::acceptor listener = listen(io);
  const std::uint16_t port = listener.local_endpoint().port();
  net::udp::socket server = net::bind_udp(io, {address_v4::loopback(), port});
  microseconds now{0};
  VrpnLink by_tcp(url_of(port), two_addresses());
  EXPECT_TRUE(work_until(by_tcp, now, [&] { return net::accept_tcp(listener).has_value(); }));
  listener.close();
  VrpnLink by_call(url_of(port), two_addresses());
  std::array<std::uint8_t, 256> buffer{};
  EXPECT_TRUE(work_until(by_call, now, [&] { return net::receive_datagram(server, buffer).has_value(); }));
}

TEST(VrpnLink, SeveralAddressesThatDoNotAnswerTakeNoLongerThanOne) {
  const std::uint16_t port = free_port();
  net::io_context io;
  for (std::vector<net::address> servers : {two_addresses(), {address_v4::loopback()}}) {
    const net::udp::socket silent = net::bind_udp(io, {servers.front(), port});
    VrpnLink link(url_of(port), servers);
    microseconds now{0};
    EXPECT_TRUE(work_until(link, now, [&] { return link.why_silent() != "nothing answers there"; }));
    EXPECT_LE(now, milliseconds(4'700)) << "a connection attempt of 1.5 s and a call back of 3 s";
  }
}

TEST(VrpnLink, WhatSpeaksSomethingElseIsNamedAsSuch) {
  net::io_context io;
  net::tcp::acceptor listener = listen(io);
  VrpnLink link(url_of(listener.local_endpoint().port()));
  microseconds now{0};
  std::optional<net::Accepted> accepted;
  ASSERT_TRUE(work_until(link, now, [&] { return (accepted = net::accept_tcp(listener)).has_value(); }));
  work_until(link, now, [&] { return link.why_silent() == "it has not answered as a VRPN server"; });
  EXPECT_EQ(link.why_silent(), "it has not answered as a VRPN server") << "as long as it says nothing";
  net::send(accepted->socket, as_bytes("SSH-2.0-OpenSSH_9.2\r\n"));
  EXPECT_TRUE(work_until(link, now, [&] {
    return link.why_silent() == "the first bytes are not those of a VRPN server of version 07";
  })) << link.why_silent();
}

TEST(VrpnLink, AServerThatSendsFasterThanWeReadCannotKeepUs) {
  net::io_context io;
  net::tcp::acceptor listener = listen(io);
  VrpnLink link(url_of(listener.local_endpoint().port()));
  microseconds now{0};
  std::optional<net::Accepted> accepted;
  ASSERT_TRUE(work_until(link, now, [&] { return (accepted = net::accept_tcp(listener)).has_value(); }));
  net::send(accepted->socket, greeting_and_pose());
  Bytes flood;
  while (flood.size() < (std::size_t{1} << 20)) append(flood, ByteView(greeting_and_pose()).subspan(24));
  net::send(accepted->socket, flood);  // as much as the system takes
  link.work(now);
  link.work(now);
  EXPECT_LE(link.take().size(), 2 * 16 * 16'384U / 88);
}

TEST(VrpnLink, AHostThatNobodyKnowsIsNamed) {
  EXPECT_THAT([] { VrpnLink{tracker_url_in("vrpn://no-such-host.invalid/ASTRO")}; },
              support::ThrowsTelling(net::AddressProblem::host_unknown, "no-such-host.invalid"));
}

}  // namespace
}  // namespace astro::truth
