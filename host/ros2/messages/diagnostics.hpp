#pragma once

#include <cstddef>

#include "host/ros2/messages/time.hpp"

namespace astro::ros2::msg {

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
