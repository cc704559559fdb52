#pragma once

#include <array>

#include "host/ros2/cdr/message.hpp"

/// How nodes announce themselves, so that `ros2 node list` shows them. ROS 2 Humble has identifiers of 24 bytes, padded with
/// zeros, later versions of 16; the types have the same names.
namespace astro::ros2::msg {

inline constexpr std::size_t kGidBytes = 16, kGidBytesOfHumble = 24;

template <std::size_t N>
struct Gid {
  std::array<std::uint8_t, N> data{};

  static constexpr std::string_view kType = "rmw_dds_common/msg/Gid";
  static constexpr std::tuple kFields{Field{&Gid::data, "data"}};
  bool operator==(const Gid&) const = default;
};

template <std::size_t N>
struct NodeEntitiesInfo {
  BoundedText<256> node_namespace, node_name;
  std::vector<Gid<N>> reader_gid_seq, writer_gid_seq;

  static constexpr std::string_view kType = "rmw_dds_common/msg/NodeEntitiesInfo";
  static constexpr std::tuple kFields{Field{&NodeEntitiesInfo::node_namespace, "node_namespace"},
                                      Field{&NodeEntitiesInfo::node_name, "node_name"},
                                      Field{&NodeEntitiesInfo::reader_gid_seq, "reader_gid_seq"},
                                      Field{&NodeEntitiesInfo::writer_gid_seq, "writer_gid_seq"}};
  bool operator==(const NodeEntitiesInfo&) const = default;
};

template <std::size_t N>
struct ParticipantEntitiesInfo {
  Gid<N> gid;
  std::vector<NodeEntitiesInfo<N>> node_entities_info_seq;

  static constexpr std::string_view kType = "rmw_dds_common/msg/ParticipantEntitiesInfo";
  static constexpr std::tuple kFields{
      Field{&ParticipantEntitiesInfo::gid, "gid"},
      Field{&ParticipantEntitiesInfo::node_entities_info_seq, "node_entities_info_seq"}};
  bool operator==(const ParticipantEntitiesInfo&) const = default;
};

}  // namespace astro::ros2::msg
