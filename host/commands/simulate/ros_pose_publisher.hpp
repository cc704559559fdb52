#pragma once

#include <memory>
#include <string>

#include "host/live/dds/discovery.hpp"
#include "host/live/dds/participant.hpp"
#include "host/simulation/server/virtual_tracker.hpp"

namespace astro::commands {

/// The node /virtual_tracker, which publishes each frame as a PoseStamped in the frame "world", reliably. header.stamp is the
/// tracker's clock.
class RosPosePublisher : public simulation::FrameSink {
 public:
  /// `topic`: its full name. Throws astro::Error if the network does not allow it.
  RosPosePublisher(const std::string& topic, const dds::Discovery& discovery);

  void send(const simulation::TrackedFrame& frame) override;

 private:
  std::unique_ptr<dds::Participant> participant_;  // before its writers, so that it outlives them
  std::unique_ptr<dds::Writer> nodes_, poses_;
};

}  // namespace astro::commands
