#pragma once

#include <memory>
#include <vector>

#include "host/formats/cdr/names.hpp"
#include "host/formats/messages/nodes.hpp"
#include "host/live/dds/participant.hpp"

/// The topic ros_discovery_info, on which each participant says which nodes it has and which endpoints belong to them. From it
/// come `ros2 node list` and `ros2 node info`.
namespace astro::live {

/// The size of identifiers. Distributions with different sizes do not understand each other's messages, although the type has
/// one name.
enum class GidSize : std::size_t {
  humble = ros2::msg::kGidBytesOfHumble,
  iron_and_later = ros2::msg::kGidBytes,
};

struct Endpoints {
  std::vector<dds::Guid> readers, writers;
};

/// The message of a participant with one node.
Bytes discovery_info(const dds::Guid& participant, const ros2::NodeName& node, const Endpoints& endpoints,
                     GidSize gid_size);

/// Publishes a node's endpoints.
class DiscoveryInfo {
 public:
  /// `participant` must outlive it.
  DiscoveryInfo(dds::Participant& participant, ros2::NodeName node, GidSize gid_size);

  void add_reader(const dds::Guid& reader);
  void add_writer(const dds::Guid& writer);
  void remove_writer(const dds::Guid& writer);

  /// Publishes all endpoints if something has changed since the last time.
  void publish_changes();

 private:
  const dds::Guid participant_;
  const ros2::NodeName node_;
  const GidSize gid_size_;
  Endpoints endpoints_;
  bool changed_ = true;
  std::unique_ptr<dds::Writer> writer_;
};

}  // namespace astro::live
