#pragma once

#include <functional>
#include <memory>
#include <string>

#include "host/formats/cdr/names.hpp"
#include "host/live/dds/discovery.hpp"
#include "host/live/dds/participant.hpp"
#include "host/live/driver/middleware.hpp"
#include "host/live/ros2/discovery_info.hpp"

namespace astro::live {

struct NodeOptions {
  ros2::NodeName name;
  GidSize gid_size = GidSize::iron_and_later;
  /// Called from poll() if another node of the same full name is there and stays; with that name.
  std::function<void(const std::string&)> on_twin = [](const std::string&) {};
  /// Called from poll() once for each topic that the node subscribes and that another node publishes under a type that the
  /// node does not take, so that none of its messages arrive. The arguments are topic and type, "/cmd_vel" and
  /// "geometry_msgs/msg/Twist".
  std::function<void(const std::string&, const std::string&)> on_foreign_type = [](const std::string&,
                                                                                   const std::string&) {};
};

/// A ROS 2 node on DDS, which the tools and nodes of others see as one of theirs, whichever RMW they use. All its callbacks
/// come from poll(); endpoints that were made or have gone are announced there, too.
///
/// Throws astro::Error if a name is not valid or the network does not allow it.
std::unique_ptr<Middleware> open_node(const NodeOptions& options, const dds::Discovery& discovery);

/// The same on a participant of any kind; its user data should be kParticipantUserData.
std::unique_ptr<Middleware> open_node(const NodeOptions& options,
                                      std::unique_ptr<dds::Participant> participant);

inline constexpr const char* kParticipantUserData = "enclave=/;";  // of a node without security

}  // namespace astro::live
