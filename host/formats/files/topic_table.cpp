#include "host/formats/files/topic_table.hpp"

#include <algorithm>

#include "host/formats/cdr/ros1.hpp"
#include "host/formats/files/compression.hpp"

namespace astro::bag {
namespace {

/// A robot has some hundred topics. The names are limited, too, because whoever inspects a bag holds five
/// copies of each.
constexpr std::size_t kMostTopics = 10'000, kMostNameBytes = std::size_t{2} << 20;

/// A field of a layout takes ten times the bytes of its line. The definitions of a robot's hundred types have
/// some 500 kB.
constexpr std::size_t kMostDefinitionBytes = std::size_t{2} << 20;

constexpr std::int64_t kLastTime_ns = (std::int64_t{1} << 62) - 1;

}  // namespace

bool TopicTable::Entry::is(std::string_view name, std::string_view type, std::string_view encoding) const {
  const bool converted = !ros1_type.empty();
  return topic.name == name && (converted ? ros1_type : topic.type) == type &&
         (converted ? "ros1" : std::string_view(topic.encoding)) == encoding;
}

TopicTable::Layout TopicTable::layout(std::string_view type, const Definition& definition) {
  const bool ros1 = definition.format == "ros1msg";
  if (!ros1 && definition.format != "ros2msg") return nullptr;
  std::string key(type);
  key.append("\0", 1)
      .append(definition.format)
      .append(std::to_string(definition.text.size()))
      .append("\0", 1);
  key += std::to_string(crc32_ieee(as_bytes(definition.text)));
  if (const auto known = layouts_.find(key); known != layouts_.end()) return known->second;
  const std::size_t bytes = key.size() + definition.text.size();
  if (bytes > kMostDefinitionBytes - definition_bytes_) return nullptr;
  definition_bytes_ += bytes;
  auto parsed = ros2::parse_definition(
      type, definition.text, ros1 ? ros2::DefinitionFormat::ros1msg : ros2::DefinitionFormat::ros2msg);
  Layout& added = layouts_[std::move(key)];
  if (parsed) added = std::make_shared<const ros2::MessageLayout>(std::move(*parsed));
  return added;
}

TopicTable::Entry* TopicTable::entry(std::string_view name, std::string_view type, std::string_view encoding,
                                     const Definition& definition) {
  const std::size_t bytes = name.size() + type.size() + encoding.size();
  if (bytes > kMostNameBytes) return nullptr;
  std::string key;
  for (const std::string_view part : {name, type, encoding}) key.append(part).push_back('\0');
  if (const auto known = entries_.find(key); known != entries_.end()) return &known->second;
  if (entries_.size() >= kMostTopics || bytes > kMostNameBytes - name_bytes_) return nullptr;
  name_bytes_ += bytes;
  Entry& added = entries_[std::move(key)];
  order_.push_back(&added);
  added.topic.name = name;
  added.topic.type = type;
  added.topic.encoding = encoding;
  added.topic.layout = layout(type, definition);
  if (encoding == "ros1") {
    added.topic.type = ros2::ros2_type_name(type);
    if (added.topic.layout) {
      added.ros1_type = type;
      added.topic.encoding = "cdr";
    }
  }
  added.wanted = handlers_.message && (!handlers_.wants || handlers_.wants(added.topic));
  return &added;
}

std::optional<MessageFault> TopicTable::take(Entry& entry, std::int64_t log_time_ns, ByteView data,
                                             ExpansionLimit& limit) {
  BagTopic& topic = entry.topic;
  log_time_ns = std::clamp(log_time_ns, -kLastTime_ns, kLastTime_ns);
  topic.first_ns = topic.messages == 0 ? log_time_ns : std::min(topic.first_ns, log_time_ns);
  topic.last_ns = topic.messages == 0 ? log_time_ns : std::max(topic.last_ns, log_time_ns);
  ++topic.messages;
  if (!entry.wanted) return std::nullopt;
  if (!entry.ros1_type.empty()) {
    const auto converted = ros2::cdr_from_ros1(*topic.layout, data);
    if (!converted)
      return MessageFault{"a message that does not fit its definition",
                          BagDamage::message_against_definition};
    handlers_.message(topic, {log_time_ns, *converted});
    return std::nullopt;
  }
  // CDR begins with a zero, so an uncompressed message is never mistaken for a compressed one.
  if (topic.encoding == "ros1" || !begins_like_zstd(data)) {
    handlers_.message(topic, {log_time_ns, data});
    return std::nullopt;
  }
  const auto expanded = expand_zstd_frame(data, std::min(limit.one_bytes, limit.all_bytes));
  if (!expanded)
    return MessageFault{"a compressed message that does not expand", BagDamage::message_does_not_expand};
  limit.all_bytes -= expanded->size();
  handlers_.message(topic, {log_time_ns, *expanded});
  return std::nullopt;
}

std::vector<BagTopic> TopicTable::topics() const {
  std::vector<BagTopic> all;
  for (const Entry* entry : order_) all.push_back(entry->topic);
  return all;
}

}  // namespace astro::bag
