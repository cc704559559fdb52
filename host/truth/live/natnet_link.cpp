#include "host/truth/live/natnet_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "host/base/error.hpp"
#include "host/truth/trackers/natnet_frame.hpp"

namespace astro::truth {

using std::chrono::microseconds;
using std::chrono::seconds;

namespace {

constexpr microseconds kCommandPeriod =
    seconds(1);  // a server drops a client that it has not heard for some seconds
constexpr microseconds kSilence = seconds(3);  // without any datagram
constexpr int kMostDatagrams = 256;            // of one call, so that a server cannot block us

/// A socket at the address by which this computer reaches the server.
net::udp::socket command_socket(net::io_context& io, const net::udp::endpoint& server) {
  return net::bind_udp(io, {net::connect_udp(io, server).local_endpoint().address(), 0});
}

constexpr natnet::Version kOldest{3, 0};

std::string list_of(const natnet::BodyNames& names) {
  constexpr std::size_t kMostShown = 20;
  std::string list;
  std::size_t shown = 0;
  for (const auto& [id, name] : names) {
    if (shown == kMostShown) return list + " and " + std::to_string(names.size() - shown) + " more";
    list += (shown++ == 0 ? "'" : ", '") + name + "'";
  }
  return list;
}

}  // namespace

void NatNetStream::push(ByteView datagram, std::int64_t arrival_us) {
  const auto packet = natnet::packet_in(datagram);
  if (!packet) return;
  if (packet->id == natnet::Id::server_info) {
    if (auto info = natnet::server_info_in(packet->payload)) server_ = std::move(info);
    needs_names_ = names_.empty();
  } else if (packet->id == natnet::Id::models && server_) {
    if (auto names = natnet::body_names_in(packet->payload, server_->version)) {
      names_ = std::move(*names);
      needs_names_ = false;
    }
  } else if (packet->id == natnet::Id::frame && server_ && server_->version >= kOldest) {
    take_frame(packet->payload, arrival_us);
  }
}

void NatNetStream::take_frame(ByteView payload, std::int64_t arrival_us) {
  const auto frame = natnet::frame_in(payload, server_->version);
  if (!frame) return;
  frames_ = true;
  needs_names_ = needs_names_ || frame->models_changed;
  in_frames_.clear();
  bool sighted = false;
  for (const natnet::RigidBody& body : frame->bodies) {
    in_frames_.push_back(body.id);
    const auto name = names_.find(body.id);
    if (name == names_.end()) {
      needs_names_ = true;
      continue;
    }
    if (body_.empty()) body_ = name->second;
    if (name->second != body_ || sighted) continue;  // a frame has one pose of a body
    sighted = true;
    seen_ = true;
    sightings_.push(
        {{natnet::exposed_us(*frame, server_->ticks_per_s), arrival_us}, body.pose, body.tracked});
  }
}

std::vector<std::string> NatNetStream::bodies() const {
  std::vector<std::string> bodies;
  for (const std::int32_t id : in_frames_)
    if (const auto name = names_.find(id); name != names_.end()) bodies.push_back(name->second);
  std::sort(bodies.begin(), bodies.end());
  return bodies;
}

std::string NatNetStream::why_silent() const {
  if (seen_) return "";
  if (!server_) return "it has not answered as a NatNet server";
  const auto [major, minor] = server_->version;
  if (server_->version < kOldest)
    return "it speaks NatNet " + std::to_string(major) + "." + std::to_string(minor) +
           ", and 3.0 is the oldest version that is read";
  if (!frames_) return server_->application + " has answered but sends no frames";
  if (names_.empty()) return server_->application + " tracks no rigid body";
  const bool known =
      std::any_of(names_.begin(), names_.end(), [&](const auto& one) { return one.second == body_; });
  if (!known && !body_.empty()) return "it knows no '" + body_ + "'; it tracks " + list_of(names_);
  return "it knows " + list_of(names_) + " but sends no pose of it";
}

NatNetLink::NatNetLink(const TrackerUrl& url) : NatNetLink(url, net::addresses_of(url.host)) {}

NatNetLink::NatNetLink(const TrackerUrl& url, const std::vector<net::address>& servers)
    : url_(url.with_usual_port(natnet::kCommandPort)), servers_(reachable(servers)), stream_(url_.body) {}

/// Leaves out servers to which this computer has no route, such as an IPv6 address where only IPv4 is set up.
std::vector<NatNetLink::Server> NatNetLink::reachable(const std::vector<net::address>& servers) {
  std::vector<Server> reachable;
  std::optional<Error> failure;
  for (const auto& address : servers) {
    const net::udp::endpoint endpoint(address, url_.port);
    try {
      reachable.push_back({endpoint, command_socket(io_, endpoint)});
    } catch (const Error& error) {
      failure = error;
    }
  }
  if (reachable.empty()) throw Error(*failure);
  return reachable;
}

void NatNetLink::work(microseconds now) {
  read(server().command, now);
  if (data_) read(*data_, now);
  if (!answered_ && stream_.server()) {
    answered_ = true;
    asked_before_ = false;
    ++connections_;
    open_data();
    ask_at_ = now;  // for the names, at once
  }
  if (answered_ && now - heard_at_ > kSilence) {
    answered_ = false;
    data_.reset();
    stream_ = NatNetStream(url_.body.empty() ? stream_.body() : url_.body);
  }
  if (now >= ask_at_) ask(now);
}

void NatNetLink::wait(microseconds timeout) {
  if (data_) {
    net::wait_to_read(io_, timeout, server().command, *data_);
  } else {
    net::wait_to_read(io_, timeout, server().command);
  }
}

void NatNetLink::read(net::udp::socket& socket, microseconds now) {
  std::array<std::uint8_t, 65'536>
      buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): receive fills it
  for (int i = 0; i < kMostDatagrams; ++i) {
    const auto datagram = net::receive_datagram(socket, buffer);
    if (!datagram) return;
    if (datagram->from.address() != server().endpoint.address()) {
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
  elsewhere_ = datagram.from.address().to_string();
}

/// If the socket for data cannot be opened, frames may still come to the other one.
void NatNetLink::open_data() {
  const natnet::ServerInfo& info = *stream_.server();
  multicast_ = info.multicast;
  try {
    const auto local = server().command.local_endpoint().address();
    data_ = multicast_ ? net::join_multicast(io_, {net::address_v4(info.group), info.data_port}, local)
                       : net::bind_udp(io_, {local, info.data_port});
    why_no_data_.clear();
  } catch (const Error& error) {
    data_.reset();
    why_no_data_ = error.what();
  }
}

void NatNetLink::ask(microseconds now) {
  if (!answered_ && std::exchange(asked_before_, true)) asked_ = (asked_ + 1) % servers_.size();
  const auto send = [this](const Bytes& datagram) {
    net::send_datagram(server().command, datagram, server().endpoint);
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
                       from_elsewhere_, servers_[asked_].endpoint.address().to_string());
  return why;
}

}  // namespace astro::truth
