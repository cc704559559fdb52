#pragma once

#include <memory>
#include <string>

#include "host/ros2/dds/discovery.hpp"
#include "host/ros2/dds/participant.hpp"
#include "host/simulation/tracker/virtual_tracker.hpp"

namespace astro::simulation {

/// The node /virtual_tracker, which publishes each frame as a PoseStamped in the frame "world", reliably. header.stamp is the
/// tracker's clock.
class RosPosePublisher : public FrameSink {
 public:
  /// `topic`: its full name. Throws astro::Error if the network does not allow it.
  RosPosePublisher(const std::string& topic, const ros2::dds::Discovery& discovery);

  void send(const TrackedFrame& frame) override;

 private:
  std::unique_ptr<ros2::dds::Participant> participant_;  // before its writers
  std::unique_ptr<ros2::dds::Writer> nodes_, poses_;
};

}  // namespace astro::simulation
