#include "host/truth/live/natnet_link.hpp"

#include <gmock/gmock.h>

#include <array>
#include <boost/asio/ip/multicast.hpp>
#include <optional>
#include <utility>

#include "host/base/network.hpp"
#include "host/truth/trackers/natnet_frame.hpp"

// The client's side of NatNet: the sense of its datagrams, and its sockets over loopback in virtual time.
namespace astro::truth {
namespace {

namespace multicast = boost::asio::ip::multicast;
using boost::asio::ip::make_address;
using natnet::Id;
using net::address_v4;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr natnet::Version kVersion{3, 1};

Bytes server_info(bool multicast = false, std::uint16_t data_port = natnet::kDataPort,
                  natnet::Version version = kVersion) {
  return natnet::datagram_of(Id::server_info,
                             natnet::payload_of(natnet::ServerInfo{
                                 "Motive", version, 1'000'000, data_port, multicast, {239, 255, 42, 99}}));
}
Bytes models(const natnet::BodyNames& names) {
  return natnet::datagram_of(Id::models, natnet::payload_of(names, kVersion));
}
Bytes frame_of(std::vector<natnet::RigidBody> bodies, bool changed = false) {
  natnet::Frame frame;
  frame.bodies = std::move(bodies);
  frame.exposed_ticks = 1234;
  frame.models_changed = changed;
  return natnet::datagram_of(Id::frame, natnet::payload_of(frame, kVersion));
}
natnet::RigidBody body_at(std::int32_t id, double x_m, bool tracked = true) {
  return {id, {x_m, 0, 0, 0, 0, 0, 1}, tracked};
}

// ---- datagrams

TEST(NatNetStream, GivesThePosesOfTheNamedBodyWithBothTimesAndWhetherItIsTracked) {
  NatNetStream stream("ASTRO");
  stream.push(server_info(), 0);
  stream.push(models({{1, "TABLE"}, {2, "ASTRO"}}), 0);
  stream.push(frame_of({body_at(1, 10), body_at(2, 20)}), 77);
  stream.push(frame_of({body_at(2, 20, false)}), 78);
  const auto sightings = stream.take();
  ASSERT_THAT(sightings, SizeIs(2));
  EXPECT_EQ(sightings[0].pose.x_m, 20);
  EXPECT_EQ(sightings[0].stamp.sender_us, 1234);
  EXPECT_EQ(sightings[0].stamp.arrival_us, 77);
  EXPECT_TRUE(sightings[0].tracked);
  EXPECT_FALSE(sightings[1].tracked);
  EXPECT_THAT(stream.take(), IsEmpty());
  EXPECT_EQ(stream.why_silent(), "");
}

TEST(NatNetStream, AsksForNamesAtFirstAndWhenTheyMayHaveChanged) {
  NatNetStream stream("ASTRO");
  EXPECT_FALSE(stream.needs_names()) << "nobody has answered";
  stream.push(server_info(), 0);
  EXPECT_TRUE(stream.needs_names());
  stream.push(models({{2, "ASTRO"}}), 0);
  EXPECT_FALSE(stream.needs_names());
  stream.push(frame_of({body_at(2, 1)}), 0);
  EXPECT_FALSE(stream.needs_names());
  stream.push(frame_of({body_at(3, 1)}), 0);
  EXPECT_TRUE(stream.needs_names()) << "an id without a name";
  stream.push(models({{2, "ASTRO"}, {3, "TABLE"}}), 0);
  EXPECT_FALSE(stream.needs_names());
  stream.push(frame_of({body_at(2, 1)}, true), 0);
  EXPECT_TRUE(stream.needs_names()) << "the server says so";
}

TEST(NatNetStream, SilenceHasALikelyCause) {
  NatNetStream stream("ASTRO");
  EXPECT_EQ(stream.why_silent(), "it has not answered as a NatNet server");
  stream.push(frame_of({body_at(2, 1)}), 0);
  stream.push(Bytes(100, 0xFF), 0);
  EXPECT_EQ(stream.why_silent(), "it has not answered as a NatNet server") << "nothing else counts before";
  stream.push(server_info(), 0);
  EXPECT_EQ(stream.why_silent(), "Motive has answered but sends no frames");
  stream.push(frame_of({}), 0);
  EXPECT_EQ(stream.why_silent(), "Motive tracks no rigid body");
  stream.push(models({{1, "TABLE"}, {2, "astro"}}), 0);
  EXPECT_EQ(stream.why_silent(), "it knows no 'ASTRO'; it tracks 'TABLE', 'astro'");
  stream.push(models({{2, "ASTRO"}}), 0);
  EXPECT_EQ(stream.why_silent(), "it knows 'ASTRO' but sends no pose of it");
  NatNetStream old("ASTRO");
  old.push(server_info(false, 0, {2, 9}), 0);
  EXPECT_EQ(old.why_silent(), "it speaks NatNet 2.9, and 3.0 is the oldest version that is read");
}

TEST(NatNetStream, WithoutANameTakesTheFirstBodyAndTellsOfTheOthers) {
  NatNetStream stream("");
  stream.push(server_info(), 0);
  stream.push(models({{1, "TABLE"}, {2, "ASTRO"}}), 0);
  stream.push(frame_of({body_at(2, 20), body_at(1, 10)}), 0);
  EXPECT_THAT(stream.take(), SizeIs(1));
  EXPECT_EQ(stream.body(), "ASTRO");
  EXPECT_THAT(stream.bodies(), ElementsAre("ASTRO", "TABLE"));
}

// ---- sockets

/// A server on loopback whose frames go where a test sends them.
struct Server {
  net::io_context io;
  net::udp::socket socket = net::bind_udp(io, {address_v4::loopback(), 0});
  std::optional<net::udp::endpoint> client;
  std::vector<Id> asked;

  std::uint16_t port() const { return socket.local_endpoint().port(); }
  void work(const Bytes& info) {
    std::array<std::uint8_t, 1024> buffer{};
    while (const auto datagram = net::receive_datagram(socket, buffer)) {
      client = datagram->from;
      asked.push_back(natnet::packet_in(datagram->bytes)->id);
      if (asked.back() == Id::connect) net::send_datagram(socket, info, *client);
      if (asked.back() == Id::request_models) net::send_datagram(socket, models({{2, "ASTRO"}}), *client);
    }
  }
};

TrackerUrl url_of(const Server& server) {
  return tracker_url_in("natnet://127.0.0.1:" + std::to_string(server.port()) + "/ASTRO");
}

/// Connects, and returns whether the names are known.
bool connected(NatNetLink& link, Server& server, const Bytes& info, microseconds& now) {
  for (int i = 0; i < 10; ++i, now += milliseconds(100)) {
    link.work(now);
    server.work(info);
  }
  return server.client && server.asked.back() == Id::keep_alive;
}

TEST(NatNetLink, TakesFramesFromEitherOfItsTwoSockets) {
  const std::uint16_t data_port = Server().port();  // nobody uses it any more
  Server server;
  NatNetLink link(url_of(server));
  microseconds now{0};
  ASSERT_TRUE(connected(link, server, server_info(false, data_port), now));
  net::send_datagram(server.socket, frame_of({body_at(2, 1)}), *server.client);
  net::send_datagram(server.socket, frame_of({body_at(2, 2)}), {server.client->address(), data_port});
  link.wait(milliseconds(100));
  link.work(now);
  EXPECT_THAT(link.take(), SizeIs(2));
  EXPECT_EQ(link.way(), "by UDP");
}

TEST(NatNetLink, AsksEachAddressOfTheHost) {
  Server server;
  NatNetLink link(url_of(server), {make_address("127.0.0.2"), address_v4::loopback()});
  microseconds now{0};
  EXPECT_TRUE(connected(link, server, server_info(), now)) << "within a second, as with one address";
}

TEST(NatNetLink, JoinsTheGroupThatTheServerNames) {
  const std::uint16_t data_port = Server().port();  // nobody uses it any more
  Server server;
  NatNetLink link(url_of(server));
  microseconds now{0};
  ASSERT_TRUE(connected(link, server, server_info(true, data_port), now));
  EXPECT_EQ(link.way(), "by multicast");
  // The frames do not leave this computer.
  server.socket.set_option(multicast::outbound_interface(address_v4::loopback()));
  server.socket.set_option(multicast::hops(0));
  net::send_datagram(server.socket, frame_of({body_at(2, 1)}), {make_address("239.255.42.99"), data_port});
  link.wait(milliseconds(1000));
  link.work(now);
  EXPECT_THAT(link.take(), SizeIs(1)) << link.why_silent();
}

TEST(NatNetLink, WhatComesFromSomebodyElseIsIgnoredAndTold) {
  Server server;
  NatNetLink link(url_of(server));
  microseconds now{0};
  ASSERT_TRUE(connected(link, server, server_info(), now));
  net::udp::socket stranger = net::bind_udp(server.io, {make_address("127.0.0.2"), 0});
  net::send_datagram(stranger, frame_of({body_at(2, 1)}), *server.client);
  link.wait(milliseconds(100));
  link.work(now);
  EXPECT_THAT(link.take(), IsEmpty());
  EXPECT_EQ(link.why_silent(),
            "Motive has answered but sends no frames; frames from 127.0.0.2 (1 so far) are not read, because "
            "127.0.0.1 "
            "was asked");
}

}  // namespace
}  // namespace astro::truth
