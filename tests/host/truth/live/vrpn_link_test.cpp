#include "host/truth/live/vrpn_link.hpp"

#include <gmock/gmock.h>

#include <array>
#include <charconv>

#include "host/base/socket.hpp"
#include "host/truth/trackers/vrpn_tracker.hpp"
#include "tests/support/base/remarks.hpp"

// The client's side of a connection, over loopback and in virtual time.
namespace astro::truth {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

/// A port of this computer that nobody listens to.
std::uint16_t free_port() { return net::Address::local(net::listen_tcp(net::Address::loopback(0))).port(); }

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
  const net::Socket server = net::bind_udp(net::Address::loopback(port));
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
  const net::Socket call = net::begin_tcp(asked->from.with_port(call_port));
  net::send(call, greeting_and_pose());
  std::vector<Sighting> sightings;
  EXPECT_TRUE(work_until(link, now, [&] {
    for (const Sighting& sighting : link.take()) sightings.push_back(sighting);
    return !sightings.empty();
  }));
  EXPECT_EQ(link.way(), "by a call back over TCP");
  Bytes cookie(vrpn::kCookieBytes);
  ASSERT_TRUE(net::wait_to_read(call, milliseconds(1000)));
  net::receive(call, cookie);
  EXPECT_EQ(cookie, vrpn::cookie());
}

/// Two addresses of one host; a test's server serves at the last of them only.
std::vector<net::Address> two_addresses(std::uint16_t port) {
  return {net::Address::all_of("127.0.0.2", port).front(), net::Address::loopback(port)};
}

TEST(VrpnLink, TriesEachAddressOfTheHostByTcpAndThenByACallBack) {
  net::Socket listener = net::listen_tcp(net::Address::loopback(0));
  const std::uint16_t port = net::Address::local(listener).port();
  const net::Socket server = net::bind_udp(net::Address::loopback(port));
  microseconds now{0};
  VrpnLink by_tcp(url_of(port), two_addresses(port));
  EXPECT_TRUE(work_until(by_tcp, now, [&] { return net::accept_tcp(listener).has_value(); }));
  listener = net::Socket();
  VrpnLink by_call(url_of(port), two_addresses(port));
  std::array<std::uint8_t, 256> buffer{};
  EXPECT_TRUE(work_until(by_call, now, [&] { return net::receive_datagram(server, buffer).has_value(); }));
}

TEST(VrpnLink, SeveralAddressesThatDoNotAnswerTakeNoLongerThanOne) {
  const std::uint16_t port = free_port();
  for (std::vector<net::Address> servers : {two_addresses(port), {net::Address::loopback(port)}}) {
    const net::Socket silent = net::bind_udp(servers.front());
    VrpnLink link(url_of(port), servers);
    microseconds now{0};
    EXPECT_TRUE(work_until(link, now, [&] { return link.why_silent() != "nothing answers there"; }));
    EXPECT_LE(now, milliseconds(4'700)) << "a connection attempt of 1.5 s and a call back of 3 s";
  }
}

TEST(VrpnLink, WhatSpeaksSomethingElseIsNamedAsSuch) {
  const net::Socket listener = net::listen_tcp(net::Address::loopback(0));
  VrpnLink link(url_of(net::Address::local(listener).port()));
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
  const net::Socket listener = net::listen_tcp(net::Address::loopback(0));
  VrpnLink link(url_of(net::Address::local(listener).port()));
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
