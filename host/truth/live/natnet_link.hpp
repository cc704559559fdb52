#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/base/network.hpp"
#include "host/truth/live/sighting.hpp"
#include "host/truth/live/tracker_link.hpp"
#include "host/truth/live/tracker_url.hpp"
#include "host/truth/trackers/natnet_models.hpp"
#include "host/truth/trackers/natnet_packet.hpp"

namespace astro::truth {

/// The poses of one body from the datagrams of a NatNet server. No I/O and no clock.
class NatNetStream {
 public:
  /// `body`: its name in Motive; "": the one that is seen first.
  explicit NatNetStream(std::string body) : body_(std::move(body)) {}

  /// Takes one datagram. Datagrams of other protocols are ignored.
  void push(ByteView datagram, std::int64_t arrival_us);

  /// The poses since the last call, oldest first.
  std::vector<Sighting> take() { return sightings_.take(); }

  /// Nothing until the server has answered: frames cannot be understood before.
  const std::optional<natnet::ServerInfo>& server() const { return server_; }
  /// Whether a frame has come whose bodies have no names yet, so that the models have to be requested.
  bool needs_names() const { return needs_names_; }

  bool has_frames() const { return frames_; }

  /// Why nothing has come of this body: a clause; "" if something has.
  std::string why_silent() const;
  /// The bodies that are in the frames.
  std::vector<std::string> bodies() const;
  const std::string& body() const { return body_; }

 private:
  void take_frame(ByteView payload, std::int64_t arrival_us);

  std::string body_;
  std::optional<natnet::ServerInfo> server_;
  natnet::BodyNames names_;
  std::vector<std::int32_t> in_frames_;  // ids of the last frame
  bool needs_names_ = false, frames_ = false, seen_ = false;
  Waiting<Sighting> sightings_;
};

/// Connects to a NatNet server by UDP. The server is asked until it answers. Its answer says whether it sends to this
/// computer alone or to a multicast group. Then it is told each second that somebody listens. If it sends to this computer
/// alone, clients disagree on which of our two sockets gets the frames, so both are read. If a host has several addresses,
/// each is asked in turn until one answers. Frames from any other address are counted but not read, because they may come
/// from another server, or from a second network card of this one.
class NatNetLink : public TrackerLink {
 public:
  /// Throws astro::Error if the host's name is unknown or no socket can be made.
  explicit NatNetLink(const TrackerUrl& url);
  /// `servers`: the addresses to ask, at least one.
  NatNetLink(const TrackerUrl& url, const std::vector<net::address>& servers);

  void work(std::chrono::microseconds now) override;
  void wait(std::chrono::microseconds timeout) override;
  std::vector<Sighting> take() override { return stream_.take(); }
  std::string why_silent() const override;
  std::vector<std::string> bodies() const override { return stream_.bodies(); }
  const std::string& body() const override { return stream_.body(); }
  std::string way() const override { return multicast_ ? "by multicast" : "by UDP"; }
  int connections() const override { return connections_; }

 private:
  using microseconds = std::chrono::microseconds;

  /// One address of the server, and the socket by which it is asked.
  struct Server {
    net::udp::endpoint endpoint;
    net::udp::socket command;
  };

  Server& server() { return servers_[asked_]; }
  std::vector<Server> reachable(const std::vector<net::address>& servers);
  void read(net::udp::socket& socket, microseconds now);
  void note_elsewhere(const net::Datagram& datagram);
  void open_data();
  void ask(microseconds now);

  TrackerUrl url_;
  net::io_context io_;  // outlives the sockets
  std::vector<Server> servers_;
  std::size_t asked_ = 0;  // the one of them that is asked now
  std::optional<net::udp::socket> data_;
  NatNetStream stream_;
  microseconds ask_at_{}, heard_at_{};
  int connections_ = 0;
  bool answered_ = false, multicast_ = false;
  bool asked_before_ = false;  // since the last answer
  std::string why_no_data_;
  std::size_t from_elsewhere_ = 0;  // frames that were not read, and where the last of them came from
  std::string elsewhere_;
};

}  // namespace astro::truth
