#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/formats/cdr/message.hpp"

/// Messages as text, in the same words whether they are structs of this project or of idlc, whose fields have the same names.
namespace astro::support {

template <class T>
std::span<const T> items(const std::vector<T>& list) {
  return list;
}
template <class List>
requires requires(const List& list) { list._length; }
auto items(const List& list) { return std::span(list._buffer, list._length); }

template <class T>
std::span<const T> items(const std::optional<T>& list) {
  return list ? std::span(&*list, 1) : std::span<const T>();
}

inline std::string one_line(std::string text) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at) text.replace(at, 1, "\\n");
  return text;
}

template <class Quaternion>
double heading(const Quaternion& q) {
  return 2 * std::atan2(q.z, q.w);
}

template <class Time>
std::string seconds(const Time& time) {
  return fmt::format("{}.{:09}", time.sec, time.nanosec);
}

inline std::string text_of_odometry(const auto& m) {
  const auto& p = m.pose.pose;
  return fmt::format(
      "stamp={} frame={} child={} x={} y={} heading={} v={} w={} var_x={} var_y={} var_heading={} var_v={} "
      "var_w={}",
      seconds(m.header.stamp), m.header.frame_id, m.child_frame_id, p.position.x, p.position.y,
      heading(p.orientation), m.twist.twist.linear.x, m.twist.twist.angular.z, m.pose.covariance[0],
      m.pose.covariance[7], m.pose.covariance[35], m.twist.covariance[0], m.twist.covariance[35]);
}

/// Each in brackets.
inline std::string text_of_transforms(const auto& m) {
  std::string text;
  for (const auto& t : items(m.transforms))
    text += fmt::format("[stamp={} {}>{} x={} y={} z={} heading={}]", seconds(t.header.stamp),
                        t.header.frame_id, t.child_frame_id, t.transform.translation.x,
                        t.transform.translation.y, t.transform.translation.z, heading(t.transform.rotation));
  return text;
}

/// name:position:velocity
inline std::string text_of_joints(const auto& m) {
  std::string text = "stamp=" + seconds(m.header.stamp);
  for (std::size_t i = 0; i < items(m.name).size(); ++i)
    text += fmt::format(" {}:{}:{}", items(m.name)[i], items(m.position)[i], items(m.velocity)[i]);
  return text;
}

inline std::string text_of_battery(const auto& m) {
  return fmt::format("stamp={} voltage={} percentage={} present={}", seconds(m.header.stamp), m.voltage,
                     m.percentage, static_cast<int>(m.present));
}

/// Each in brackets: its level, its name and its message.
inline std::string text_of_diagnostics(const auto& m) {
  std::string text;
  for (const auto& status : items(m.status))
    text += fmt::format("[{} {}: {}]", static_cast<int>(status.level), status.name, status.message);
  return one_line(text);
}

inline std::string text_of_pose(const auto& m) {
  return fmt::format("stamp={} frame={} x={} y={} heading={}", seconds(m.header.stamp), m.header.frame_id,
                     m.pose.position.x, m.pose.position.y, heading(m.pose.orientation));
}

/// As `ros2 param get` shows it, "none" for one that is not set or of another type.
inline std::string text_of_value(const auto& value) {
  switch (value.type) {
    case 1:
      return value.bool_value ? "true" : "false";
    case 2:
      return std::to_string(value.integer_value);
    case 3:
      return fmt::format("{}", value.double_value);
    case 4:
      return fmt::format("{}", value.string_value);
    default:
      return "none";
  }
}

inline std::string text_of_event(const auto& m) {
  std::string text = fmt::format("stamp={} node={}", seconds(m.stamp), m.node);
  for (const auto& each : items(m.changed_parameters))
    text += fmt::format(" {}={}", each.name, text_of_value(each.value));
  return text;
}

inline std::string words_of(const auto& list) { return fmt::format("{}", fmt::join(items(list), " ")); }

/// As `ros2 param set` understands a word: true or false, a whole number, a number, or a text.
inline void fill_value(auto& value, const std::string& word) {
  std::size_t end = 0;
  try {
    value.double_value = std::stod(word, &end);
  } catch (const std::exception&) {
  }
  const bool number = end == word.size() && end > 0;
  const bool whole = number && word.find_first_not_of("+-0123456789") == std::string::npos;
  value.type = word == "true" || word == "false" ? 1 : whole ? 2 : number ? 3 : 4;
  value.bool_value = word == "true";
  if (whole) value.integer_value = std::stoll(word);
}

inline std::string text_of_descriptor(const auto& m) {
  std::string text = fmt::format("type={} read_only={}", m.type, static_cast<int>(m.read_only));
  for (const auto& range : items(m.floating_point_range))
    text += fmt::format(" from={} to={}", range.from_value, range.to_value);
  for (const auto& range : items(m.integer_range))
    text += fmt::format(" from={} to={}", range.from_value, range.to_value);
  return one_line(text + fmt::format(" {}", m.description));
}

inline std::string hexadecimal(const auto& bytes) { return fmt::format("{:02x}", fmt::join(bytes, "")); }

inline std::string gids(const auto& list) {
  std::string text;
  for (const auto& gid : items(list)) text += (text.empty() ? "" : ",") + hexadecimal(gid.data);
  return text;
}

inline const std::string& plain(const std::string& text) { return text; }
inline std::string plain(const char* text) { return text; }
template <std::size_t N>
const std::string& plain(const ros2::BoundedText<N>& text) {
  return text.text;
}

/// Each node in brackets.
inline std::string text_of_graph(const auto& m) {
  std::string text = "participant=" + hexadecimal(m.gid.data);
  for (const auto& node : items(m.node_entities_info_seq))
    text += fmt::format(" [namespace={} name={} readers={} writers={}]", plain(node.node_namespace),
                        plain(node.node_name), gids(node.reader_gid_seq), gids(node.writer_gid_seq));
  return text;
}

}  // namespace astro::support
