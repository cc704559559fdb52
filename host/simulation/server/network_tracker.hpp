#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/recording/run.hpp"
#include "host/simulation/server/virtual_tracker.hpp"
#include "host/truth/trackers/natnet_packet.hpp"

namespace astro::simulation {

class NatNetServer;
class VrpnServer;

struct NetworkTrackerConfig {
  std::optional<std::uint16_t> vrpn_port;    // 0: any that is free; nothing: no VRPN
  std::optional<std::uint16_t> natnet_port;  // the same for NatNet
  truth::natnet::Version natnet_version{4, 1};
  std::uint16_t natnet_data_port =
      truth::natnet::kDataPort;  // that NatNet clients are told; 0: any of theirs
  bool everywhere = false;       // other computers may connect, too
  std::string body = "ASTRO";
  TrackingFaults faults;
  std::shared_ptr<FrameSink> also;  // another receiver of the frames; may be empty
};

/// The tracking software beside a simulated robot: sends what its cameras see by the configured protocols.
/// Its clock starts at the time of day and advances with the simulation.
class NetworkTracker {
 public:
  /// Throws astro::Error if a port is in use.
  explicit NetworkTracker(const NetworkTrackerConfig& config);
  ~NetworkTracker();

  /// Advances the simulation's time by a millisecond, in which the cameras have seen `seen`.
  void step(const std::vector<recording::TruthSample>& seen);
  /// Serves the clients; call often.
  void work();

  /// Null if this protocol is not served.
  const VrpnServer* vrpn() const { return vrpn_.get(); }
  const NatNetServer* natnet() const { return natnet_.get(); }
  /// Where the protocols that are served find the body: "vrpn://127.0.0.1:3883/ASTRO".
  std::vector<std::string> urls() const;

 private:
  VirtualTracker tracker_;
  std::shared_ptr<FrameSink> also_;
  std::string body_;
  std::unique_ptr<VrpnServer> vrpn_;
  std::unique_ptr<NatNetServer> natnet_;
  std::int64_t now_us_;
};

}  // namespace astro::simulation
