#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/base/network.hpp"
#include "host/truth/live/tracker_link.hpp"
#include "host/truth/live/tracker_url.hpp"
#include "host/truth/live/vrpn_stream.hpp"

namespace astro::truth {

/// Connects to a VRPN server over TCP. Most servers serve anybody who connects. If this one does not, it is asked by UDP to
/// connect back to a port of ours, as the upstream library does; then this computer's firewall must let it in. If a host has
/// several addresses, each is tried, because a server may listen at only one of them. All of them together share the time-out
/// of one.
class VrpnLink : public TrackerLink {
 public:
  /// Throws astro::Error if the host's name is unknown.
  explicit VrpnLink(const TrackerUrl& url);
  /// `servers`: the addresses to try, at least one.
  VrpnLink(const TrackerUrl& url, std::vector<net::address> servers);

  void work(std::chrono::microseconds now) override;
  void wait(std::chrono::microseconds timeout) override;
  std::vector<Sighting> take() override { return stream_.take(); }
  std::string why_silent() const override;
  std::vector<std::string> bodies() const override { return stream_.senders(); }
  const std::string& body() const override { return stream_.body(); }
  std::string way() const override { return called_back_ ? "by a call back over TCP" : "over TCP"; }
  int connections() const override { return connections_; }

 private:
  enum class State : std::uint8_t { down, connecting, asking, up };

  using microseconds = std::chrono::microseconds;

  const net::address& server() const { return servers_[tried_]; }
  microseconds share_of(microseconds limit) const;
  void begin(microseconds now);
  void begin_next(microseconds now);
  void ask(microseconds now);
  void ask_next(microseconds now, const std::string& why);
  void repeat_asking(microseconds now);
  void drop_sockets();
  void rise(net::tcp::socket socket);
  void fall(microseconds now, const std::string& why);
  void read(microseconds now);

  TrackerUrl url_;
  std::vector<net::address> servers_;
  std::size_t tried_ = 0;  // the one of them that is tried now
  VrpnStream stream_;
  State state_ = State::down;
  net::io_context io_;  // outlives the sockets
  std::optional<net::Attempt> attempt_;
  std::optional<net::tcp::socket> connection_;
  std::optional<net::tcp::acceptor> listener_;
  std::optional<net::udp::socket> asking_;
  microseconds due_{};  // of the next step of the state
  microseconds deadline_{};
  int connections_ = 0;
  bool called_back_ = false;
  std::string why_down_;
};

}  // namespace astro::truth
