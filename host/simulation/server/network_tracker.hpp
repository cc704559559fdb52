#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/recording/run.hpp"
#include "host/simulation/server/natnet_server.hpp"
#include "host/simulation/server/virtual_tracker.hpp"
#include "host/simulation/server/vrpn_server.hpp"

namespace astro::simulation {

struct NetworkTrackerConfig {
  std::optional<std::uint16_t> vrpn_port;    // 0: any that is free; nothing: no VRPN
  std::optional<std::uint16_t> natnet_port;  // the same for NatNet
  truth::natnet::Version natnet_version{4, 1};
  bool everywhere = false;  // also other computers may connect
  std::string body = "ASTRO";
  TrackingFaults faults;
  std::shared_ptr<FrameSink> also;  // where else frames go; nothing: nowhere
};

/// The tracking software beside a simulated robot: what its cameras see goes out by the protocols that are
/// asked for. Its clock shows about the time of day, and passes with the simulation.
class NetworkTracker {
 public:
  /// Throws astro::Error if a port is in use.
  explicit NetworkTracker(const NetworkTrackerConfig& config);

  /// A millisecond of the simulation, and what the cameras have seen in it.
  void step(const std::vector<recording::TruthSample>& seen);
  /// Serves the clients; call often.
  void work();

  /// Empty if it does not serve that.
  const std::optional<VrpnServer>& vrpn() const { return vrpn_; }
  const std::optional<NatNetServer>& natnet() const { return natnet_; }

 private:
  VirtualTracker tracker_;
  std::shared_ptr<FrameSink> also_;
  std::optional<VrpnServer> vrpn_;
  std::optional<NatNetServer> natnet_;
  std::int64_t now_us_;
};

}  // namespace astro::simulation
