#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "host/base/bytes.hpp"

namespace astro::truth {

/// Which node has which writers and readers, as nodes announce it on the topic ros_discovery_info: of ROS 2 Humble and of
/// later versions, whose identifiers have other lengths. Bounds: some thousand participants and some ten thousand endpoints.
class NodeNames {
 public:
  using Guid = std::array<std::uint8_t, 16>;  // of an endpoint

  /// What one participant says of all its nodes, in place of what it has said before. Bytes that are no such message are
  /// ignored.
  void take(ByteView message);

  /// "/vrpn_mocap"; "" if it is not known.
  std::string node_of(const Guid& endpoint) const;

 private:
  template <class Info>
  void note(const Info& info);

  std::map<Guid, std::map<Guid, std::string>> nodes_;  // by participant, by endpoint
  std::size_t endpoints_ = 0;                          // of all participants
};

}  // namespace astro::truth
