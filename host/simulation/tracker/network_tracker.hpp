#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/recording/run/run.hpp"
#include "host/simulation/tracker/virtual_tracker.hpp"
#include "host/simulation/tracker/vrpn_server.hpp"

namespace astro::simulation {

struct NetworkTrackerConfig {
  std::optional<std::uint16_t> vrpn_port;  // 0: any that is free; nothing: no VRPN
  bool everywhere = false;                 // also other computers may connect
  std::string body = "ASTRO";
  TrackingFaults faults;
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

  /// Empty if it serves no VRPN.
  const std::optional<VrpnServer>& vrpn() const { return vrpn_; }

 private:
  VirtualTracker tracker_;
  std::optional<VrpnServer> vrpn_;
  std::int64_t now_us_;
};

}  // namespace astro::simulation
