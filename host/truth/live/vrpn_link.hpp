#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/base/net/socket.hpp"
#include "host/truth/live/tracker_link.hpp"
#include "host/truth/live/tracker_url.hpp"
#include "host/truth/live/vrpn_stream.hpp"

namespace astro::truth {

/// A VRPN server, over TCP. Most serve whoever connects. If this one does not, it is asked by UDP to call back
/// at a port of ours, as the upstream library does it; then this computer's firewall must let it in.
class VrpnLink : public TrackerLink {
 public:
  /// Throws astro::Error if the host's name is unknown.
  explicit VrpnLink(const TrackerUrl& url);

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

  void begin(microseconds now);
  void ask(microseconds now);
  void repeat_asking(microseconds now);
  void rise(net::Socket socket);
  void fall(microseconds now, const std::string& why);
  void read(microseconds now);

  TrackerUrl url_;
  net::Address server_;
  VrpnStream stream_;
  State state_ = State::down;
  net::Socket connection_, listener_, asking_;
  microseconds due_{};  // of the next step of the state
  microseconds deadline_{};
  int connections_ = 0;
  bool called_back_ = false;
  std::string why_down_;
};

}  // namespace astro::truth
