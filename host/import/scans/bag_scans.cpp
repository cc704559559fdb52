#include "host/import/scans/bag_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/import/bags/pose_topics.hpp"
#include "host/import/bags/stamp_count.hpp"
#include "host/import/scans/carmen_log.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "host/truth/scanners/laser_scan.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using ros2::msg::LaserScan;

bool holds_scans(const bag::BagTopic& topic) {
  return topic.type == LaserScan::kType && topic.encoding == "cdr" && topic.messages > 0;
}

/// Messages that cannot be read are left out. Returns how many.
std::size_t each_scan(const fs::path& path, const std::string& topic,
                      const std::function<void(lidar::Scan&, std::int64_t)>& handle) {
  std::size_t left_out = 0;
  bag::BagHandlers handlers;
  handlers.wants = [&](const bag::BagTopic& at) { return at.name == topic && at.type == LaserScan::kType; };
  handlers.message = [&](const bag::BagTopic&, const bag::BagMessage& message) {
    std::optional<LaserScan> decoded = ros2::decode<LaserScan>(message.data);
    std::optional<lidar::Scan> scan = decoded ? truth::scan_in(std::move(*decoded)) : std::nullopt;
    if (scan)
      handle(*scan, message.log_time_ns);
    else
      ++left_out;
  };
  bag::read_bag(path, handlers);
  return left_out;
}

void tell_of_unreadable(const fs::path& path, std::size_t kept, std::size_t left_out, BagScans& found) {
  if (kept == 0)
    throw Error(
        fmt::format("none of the {} scans of {} in '{}' can be read", left_out, found.topic, path.string()),
        ScanFileProblem::all_unreadable, {path.string(), found.topic, fmt::format("{}", left_out)});
  if (left_out > 0)
    found.remarks.push_back(
        {fmt::format("scans of {}: {} cannot be read and were left out", found.topic, left_out)});
}

std::string chosen_topic(const fs::path& path, const std::string& topic) {
  const std::vector<std::string> names = scan_topics(bag::read_bag(path).topics);
  if (names.empty())
    throw Error(
        "'" + path.string() + "' has no scans: no topic is of the type " + std::string(LaserScan::kType),
        ScanFileProblem::no_scans, {path.string()});
  if (!topic.empty() && std::find(names.begin(), names.end(), topic) == names.end())
    throw Error("'" + path.string() + "' has no scans on " + topic + "; it has " + listed(names),
                ScanFileProblem::topic_unclear, names);
  if (topic.empty() && names.size() > 1)
    throw Error("'" + path.string() + "' has scans on several topics: " + listed(names),
                ScanFileProblem::topic_unclear, names);
  return topic.empty() ? names.front() : topic;
}

}  // namespace

std::vector<std::string> scan_topics(const std::vector<bag::BagTopic>& topics) {
  std::vector<std::string> names;
  for (const bag::BagTopic& topic : topics)
    if (holds_scans(topic)) names.push_back(topic.name);
  return names;
}

BagScans scans_in_bag(const fs::path& path, const std::string& topic) {
  BagScans found;
  found.topic = chosen_topic(path, topic);
  StampCount stamps;
  std::size_t kept = 0;
  const std::size_t left_out = each_scan(path, found.topic, [&](const lidar::Scan& scan, std::int64_t) {
    stamps.take(scan.time_ns);
    ++kept;
  });
  tell_of_unreadable(path, kept, left_out, found);
  const bool stamped = stamps.most_are_set();
  if (stamped) {
    stamps.remark("scans of " + found.topic, found.remarks);
  } else {
    found.remarks.push_back({"scans of " + found.topic + " have no stamps: the recorder's times are used"});
  }
  found.read = [path, name = found.topic, stamps, stamped](const lidar::ScanHandler& handle) {
    each_scan(path, name, [&](lidar::Scan& scan, std::int64_t log_time_ns) {
      if (stamped && stamps.is_missing(scan.time_ns)) return;
      if (!stamped) scan.time_ns = log_time_ns;
      handle(scan);
    });
  };
  return found;
}

bool has_scans_alone(const fs::path& path) {
  if (!bag::is_bag(path) || scan_topics(bag::read_bag(path).topics).empty()) return false;
  return recognised_stream(pose_streams(path)) == nullptr;
}

}  // namespace astro::importing
