#include "host/truth/live/natnet_link.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "host/base/error.hpp"

namespace astro::truth {

using std::chrono::microseconds;
using std::chrono::seconds;

namespace {

constexpr microseconds kCommandPeriod =
    seconds(1);  // a server drops a client that it has not heard for some seconds
constexpr microseconds kSilence = seconds(3);  // without any datagram
constexpr int kMostDatagrams = 256;            // of one call, so that a server cannot keep us

/// At the address by which this computer reaches the server.
net::Socket command_socket(const net::Address& server) {
  return net::bind_udp(net::Address::local(net::connect_udp(server)).with_port(0));
}

}  // namespace

NatNetLink::NatNetLink(const TrackerUrl& url)
    : NatNetLink(url, net::Address::all_of(url.host, url.with_usual_port(natnet::kCommandPort).port)) {}

NatNetLink::NatNetLink(const TrackerUrl& url, const std::vector<net::Address>& servers)
    : url_(url.with_usual_port(natnet::kCommandPort)), servers_(reachable(servers)), stream_(url_.body) {}

/// Without those that this computer has no route to, as to an address of IPv6 where only IPv4 is set up.
std::vector<NatNetLink::Server> NatNetLink::reachable(const std::vector<net::Address>& servers) {
  std::vector<Server> reachable;
  std::optional<Error> failure;
  for (const net::Address& address : servers) {
    try {
      reachable.push_back({address, command_socket(address)});
    } catch (const Error& error) {
      failure = error;
    }
  }
  if (reachable.empty()) throw Error(*failure);
  return reachable;
}

void NatNetLink::work(microseconds now) {
  read(server().command, now);
  if (data_) read(data_, now);
  if (!answered_ && stream_.server()) {
    answered_ = true;
    asked_before_ = false;
    ++connections_;
    open_data();
    ask_at_ = now;  // for the names, at once
  }
  if (answered_ && now - heard_at_ > kSilence) {
    answered_ = false;
    data_ = {};
    stream_ = NatNetStream(url_.body.empty() ? stream_.body() : url_.body);
  }
  if (now >= ask_at_) ask(now);
}

void NatNetLink::wait(microseconds timeout) { net::wait_to_read(server().command, data_, timeout); }

void NatNetLink::read(const net::Socket& socket, microseconds now) {
  std::array<std::uint8_t, 65'536>
      buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): receive fills it
  for (int i = 0; i < kMostDatagrams; ++i) {
    const auto datagram = net::receive_datagram(socket, buffer);
    if (!datagram) return;
    if (datagram->from.host() != server().address.host()) {
      note_elsewhere(*datagram);
      continue;
    }
    heard_at_ = now;
    stream_.push(datagram->bytes, now.count());
  }
}

void NatNetLink::note_elsewhere(const net::Datagram& datagram) {
  const auto packet = natnet::packet_in(datagram.bytes);
  if (!packet || packet->id != natnet::Id::frame) return;
  ++from_elsewhere_;
  elsewhere_ = datagram.from.host();
}

/// Without its own socket for data there may still be frames at the other one.
void NatNetLink::open_data() {
  const natnet::ServerInfo& info = *stream_.server();
  multicast_ = info.multicast;
  try {
    const net::Address local = net::Address::local(server().command);
    data_ = multicast_ ? net::join_multicast(info.group, info.data_port, local)
                       : net::bind_udp(local.with_port(info.data_port));
    why_no_data_.clear();
  } catch (const Error& error) {
    data_ = {};
    why_no_data_ = error.what();
  }
}

void NatNetLink::ask(microseconds now) {
  if (!answered_ && std::exchange(asked_before_, true)) asked_ = (asked_ + 1) % servers_.size();
  const auto send = [this](const Bytes& datagram) {
    net::send_datagram(server().command, datagram, server().address);
  };
  if (!answered_) {
    send(natnet::connect_request());
  } else {
    if (now - ask_at_ > kCommandPeriod) send(natnet::connect_request());  // it may have dropped us meanwhile
    if (stream_.needs_names()) send(natnet::datagram_of(natnet::Id::request_models));
    send(natnet::datagram_of(natnet::Id::keep_alive));
  }
  ask_at_ = now + (answered_ ? kCommandPeriod : kCommandPeriod / static_cast<std::int64_t>(servers_.size()));
}

std::string NatNetLink::why_silent() const {
  std::string why = answered_ ? stream_.why_silent() : "nothing answers there as a NatNet server";
  if (why.empty()) return why;
  if (answered_ && !stream_.has_frames() && !why_no_data_.empty()) why += " (" + why_no_data_ + ")";
  if (from_elsewhere_ > 0)
    why += fmt::format("; frames from {} ({} so far) are not read, because {} was asked", elsewhere_,
                       from_elsewhere_, server().address.host());
  return why;
}

}  // namespace astro::truth
