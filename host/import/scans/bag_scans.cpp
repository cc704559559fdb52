#include "host/import/scans/bag_scans.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/import/bags/pose_topics.hpp"
#include "host/import/bags/stamp_count.hpp"
#include "host/import/scans/carmen_log.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using ros2::msg::LaserScan;

bool holds_scans(const bag::BagTopic& topic) {
  return topic.type == LaserScan::kType && topic.encoding == "cdr" && topic.messages > 0;
}

std::int64_t stamp_ns(const LaserScan& message) {
  return 1'000'000'000 * static_cast<std::int64_t>(message.header.stamp.sec) +
         static_cast<std::int64_t>(message.header.stamp.nanosec);
}

/// A scan that takes more than a second is none of a robot that drives: a driver gave another unit.
lidar::Scan scan_of(LaserScan& message, std::int64_t time_ns) {
  constexpr double kLongest_s = 1;
  const double takes_s =
      static_cast<double>(message.time_increment) * static_cast<double>(message.ranges.size());
  const bool timed = takes_s > 0 && takes_s < kLongest_s;
  return {time_ns,
          message.angle_min,
          message.angle_increment,
          timed ? static_cast<double>(message.time_increment) : 0,
          message.range_min,
          message.range_max,
          std::move(message.ranges)};
}

bool can_be_read(const LaserScan& message) {
  return std::isfinite(message.angle_min) && std::isfinite(message.angle_increment) &&
         message.angle_increment != 0;
}

/// Messages that cannot be read are left out.
void each_scan(const fs::path& path, const std::string& topic,
               const std::function<void(LaserScan&, std::int64_t)>& handle) {
  bag::BagHandlers handlers;
  handlers.wants = [&](const bag::BagTopic& at) { return at.name == topic && at.type == LaserScan::kType; };
  handlers.message = [&](const bag::BagTopic&, const bag::BagMessage& message) {
    std::optional<LaserScan> scan = ros2::decode<LaserScan>(message.data);
    if (scan && can_be_read(*scan)) handle(*scan, message.log_time_ns);
  };
  bag::read_bag(path, handlers);
}

std::vector<std::string> scan_topics(const fs::path& path) {
  std::vector<std::string> names;
  for (const bag::BagTopic& topic : bag::read_bag(path).topics)
    if (holds_scans(topic)) names.push_back(topic.name);
  return names;
}

std::string chosen_topic(const fs::path& path, const std::string& topic) {
  const std::vector<std::string> names = scan_topics(path);
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

BagScans scans_in_bag(const fs::path& path, const std::string& topic) {
  BagScans found;
  found.topic = chosen_topic(path, topic);
  StampCount stamps;
  each_scan(path, found.topic, [&](LaserScan& scan, std::int64_t) { stamps.take(stamp_ns(scan)); });
  const bool stamped = stamps.most_are_set();
  if (stamped) {
    stamps.remark("scans of " + found.topic, found.remarks);
  } else {
    found.remarks.push_back({"scans of " + found.topic + " have no stamps: the recorder's times are used"});
  }
  found.read = [path, name = found.topic, stamps, stamped](const lidar::ScanHandler& handle) {
    each_scan(path, name, [&](LaserScan& scan, std::int64_t log_time_ns) {
      const std::int64_t time_ns = stamp_ns(scan);
      if (stamped && stamps.is_missing(time_ns)) return;
      handle(scan_of(scan, stamped ? time_ns : log_time_ns));
    });
  };
  return found;
}

bool has_scans_alone(const fs::path& path) {
  if (!bag::is_bag(path) || scan_topics(path).empty()) return false;
  return recognised_stream(pose_streams(path)) == nullptr;
}

}  // namespace astro::importing
