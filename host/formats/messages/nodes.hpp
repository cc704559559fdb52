#pragma once

#include <array>
#include <cstddef>

#include "host/formats/cdr/message.hpp"
#include "host/formats/messages/std.hpp"

/// What nodes say of themselves: who they are (rmw_dds_common), their log (rcl_interfaces), and how they are (diagnostic_msgs).
namespace astro::ros2::msg {

/// How nodes announce themselves, so that `ros2 node list` shows them. ROS 2 Humble has identifiers of 24 bytes, padded with zeros,
/// later versions of 16; the types have the same names.
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

struct Log {
  Time stamp;
  std::uint8_t level = 0;
  std::string name, msg, file, function;
  std::uint32_t line = 0;

  static constexpr std::string_view kType = "rcl_interfaces/msg/Log";
  static constexpr std::tuple kFields{Field{&Log::stamp, "stamp"}, Field{&Log::level, "level"},
                                      Field{&Log::name, "name"},   Field{&Log::msg, "msg"},
                                      Field{&Log::file, "file"},   Field{&Log::function, "function"},
                                      Field{&Log::line, "line"}};
  bool operator==(const Log&) const = default;
};

struct KeyValue {
  std::string key, value;

  static constexpr std::string_view kType = "diagnostic_msgs/msg/KeyValue";
  static constexpr std::tuple kFields{Field{&KeyValue::key, "key"}, Field{&KeyValue::value, "value"}};
  bool operator==(const KeyValue&) const = default;
};

struct DiagnosticStatus {
  std::byte level{};
  std::string name, message, hardware_id;
  std::vector<KeyValue> values;

  static constexpr std::string_view kType = "diagnostic_msgs/msg/DiagnosticStatus";
  static constexpr std::tuple kFields{
      Field{&DiagnosticStatus::level, "level"}, Field{&DiagnosticStatus::name, "name"},
      Field{&DiagnosticStatus::message, "message"}, Field{&DiagnosticStatus::hardware_id, "hardware_id"},
      Field{&DiagnosticStatus::values, "values"}};
  bool operator==(const DiagnosticStatus&) const = default;
};

struct DiagnosticArray {
  Header header;
  std::vector<DiagnosticStatus> status;

  static constexpr std::string_view kType = "diagnostic_msgs/msg/DiagnosticArray";
  static constexpr std::tuple kFields{Field{&DiagnosticArray::header, "header"},
                                      Field{&DiagnosticArray::status, "status"}};
  bool operator==(const DiagnosticArray&) const = default;
};

}  // namespace astro::ros2::msg
