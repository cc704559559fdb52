#include "host/simulation/server/natnet_server.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "host/truth/trackers/natnet_frame.hpp"
#include "host/truth/trackers/natnet_models.hpp"

namespace astro::simulation {

namespace natnet = truth::natnet;

namespace {

constexpr std::size_t kMostListeners = 16;
constexpr std::int64_t kClientTimeout_us = 5'000'000;
constexpr std::uint64_t kTicksPerMicrosecond = 10;
constexpr std::int32_t kBodyId = 1;

std::uint64_t ticks(std::int64_t time_us) {
  return kTicksPerMicrosecond * static_cast<std::uint64_t>(time_us);
}

}  // namespace

NatNetServer::NatNetServer(const net::udp::endpoint& at, std::string body, natnet::Version version,
                           std::uint16_t data_port)
    : socket_(net::bind_udp(io_, at)), body_(std::move(body)), version_(version), data_port_(data_port) {}

void NatNetServer::work(std::int64_t now_us) {
  std::array<std::uint8_t, 1024> buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): receive fills it
  while (const auto datagram = net::receive_datagram(socket_, buffer)) take(*datagram, now_us);
  std::erase_if(clients_, [&](const Client& client) { return now_us - client.heard_us > kClientTimeout_us; });
}

/// False if the sender is not a client: it has not connected, or there are too many.
bool NatNetServer::note_client(const net::udp::endpoint& from, bool connects, std::int64_t now_us) {
  const auto known = std::find_if(clients_.begin(), clients_.end(),
                                  [&](const Client& client) { return client.endpoint == from; });
  if (known != clients_.end()) {
    known->heard_us = now_us;
    return true;
  }
  if (!connects || clients_.size() >= kMostListeners) return false;
  clients_.push_back({from, now_us});
  return true;
}

void NatNetServer::take(const net::Datagram& datagram, std::int64_t now_us) {
  const auto packet = natnet::packet_in(datagram.bytes);
  if (!packet || !note_client(datagram.from, packet->id == natnet::Id::connect, now_us)) return;
  const auto reply = [&](natnet::Id id, ByteView payload) {
    net::send_datagram(socket_, natnet::datagram_of(id, payload), datagram.from);
  };
  if (packet->id == natnet::Id::connect) {
    reply(natnet::Id::server_info, natnet::payload_of(natnet::ServerInfo{
                                       "Astrolabe", version_, 1'000'000 * kTicksPerMicrosecond, data_port_}));
  } else if (packet->id == natnet::Id::request_models) {
    reply(natnet::Id::models, natnet::payload_of(natnet::BodyNames{{kBodyId, body_}}, version_));
  } else if (packet->id == natnet::Id::echo_request && packet->payload.size() == sizeof(std::uint64_t)) {
    Bytes both(packet->payload.begin(), packet->payload.end());
    append(both, ticks(now_us));
    reply(natnet::Id::echo_response, both);
  }
}

void NatNetServer::send(const TrackedFrame& frame, std::int64_t now_us) {
  natnet::Frame out;
  out.number = frame.number;
  out.bodies = {{kBodyId, frame.pose, true}};
  out.timestamp_s = 1e-6 * static_cast<double>(frame.exposed_us);
  out.exposed_ticks = ticks(frame.exposed_us);
  out.received_ticks = out.sent_ticks = ticks(now_us);
  const Bytes datagram = natnet::datagram_of(natnet::Id::frame, natnet::payload_of(out, version_));
  for (const Client& client : clients_) net::send_datagram(socket_, datagram, client.endpoint);
}

}  // namespace astro::simulation
