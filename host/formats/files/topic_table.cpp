#include "host/formats/files/topic_table.hpp"

#include <algorithm>

#include "host/formats/files/compression.hpp"

namespace astro::bag {
namespace {

/// A robot has some hundred topics. The names are limited, too, because whoever inspects a bag holds five
/// copies of each.
constexpr std::size_t kMostTopics = 10'000, kMostNameBytes = std::size_t{2} << 20;

constexpr std::int64_t kLastTime_ns = (std::int64_t{1} << 62) - 1;

}  // namespace

TopicTable::Entry* TopicTable::entry(std::string_view name, std::string_view type,
                                     std::string_view encoding) {
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
  added.wanted = handlers_.message && (!handlers_.wants || handlers_.wants(added.topic));
  return &added;
}

bool TopicTable::take(Entry& entry, std::int64_t log_time_ns, ByteView data, ExpansionLimit& limit) {
  BagTopic& topic = entry.topic;
  log_time_ns = std::clamp(log_time_ns, -kLastTime_ns, kLastTime_ns);
  topic.first_ns = topic.messages == 0 ? log_time_ns : std::min(topic.first_ns, log_time_ns);
  topic.last_ns = topic.messages == 0 ? log_time_ns : std::max(topic.last_ns, log_time_ns);
  ++topic.messages;
  if (!entry.wanted) return true;
  // CDR begins with a zero, so an uncompressed message is never mistaken for a compressed one.
  if (!begins_like_zstd(data)) {
    handlers_.message(topic, {log_time_ns, data});
    return true;
  }
  const auto expanded = expand_zstd_frame(data, std::min(limit.one_bytes, limit.all_bytes));
  if (!expanded) return false;
  limit.all_bytes -= expanded->size();
  handlers_.message(topic, {log_time_ns, *expanded});
  return true;
}

std::vector<BagTopic> TopicTable::topics() const {
  std::vector<BagTopic> all;
  for (const Entry* entry : order_) all.push_back(entry->topic);
  return all;
}

}  // namespace astro::bag
