#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "host/base/net/socket.hpp"
#include "host/truth/live/natnet_stream.hpp"
#include "host/truth/live/tracker_link.hpp"
#include "host/truth/live/tracker_url.hpp"

namespace astro::truth {

/// A NatNet server, by UDP. It is asked until it answers, tells then whether it sends to this computer alone
/// or to a multicast group, and is told each second that somebody listens. Clients disagree to which of our
/// two sockets a server sends its frames to this computer alone, so both are read. Of a host with several addresses
/// each is asked in turn until one answers. Frames from any other address are not read but counted: they may be those
/// of another server, or of a second network card of this one.
class NatNetLink : public TrackerLink {
 public:
  /// Throws astro::Error if the host's name is unknown or no socket can be made.
  explicit NatNetLink(const TrackerUrl& url);
  /// `servers`: the addresses to ask, at least one.
  NatNetLink(const TrackerUrl& url, const std::vector<net::Address>& servers);

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
    net::Address address;
    net::Socket command;
  };

  const Server& server() const { return servers_[asked_]; }
  static std::vector<Server> reachable(const std::vector<net::Address>& servers);
  void read(const net::Socket& socket, microseconds now);
  void note_elsewhere(const net::Datagram& datagram);
  void open_data();
  void ask(microseconds now);

  TrackerUrl url_;
  std::vector<Server> servers_;
  std::size_t asked_ = 0;  // the one of them that is asked now
  net::Socket data_;
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
