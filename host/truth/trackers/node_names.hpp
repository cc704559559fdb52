#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "host/base/bytes.hpp"

namespace astro::truth {

/// Which node has which writers and readers, as nodes announce it on the topic ros_discovery_info. It reads messages of ROS 2
/// Humble and of later versions, whose identifiers have another length. Bounds: some thousand participants and some ten
/// thousand endpoints.
class NodeNames {
 public:
  using Guid = std::array<std::uint8_t, 16>;  // of an endpoint

  /// Takes what one participant announces of all its nodes, which replaces what it has announced before. Bytes that are no
  /// such message are ignored.
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
