#include "host/import/scans/bag_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
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

/// No scanner has more beams or sees beyond a turn. Without such limits a damaged message takes an hour, or has points nowhere.
bool can_be_read(const LaserScan& message) {
  constexpr std::size_t kMostBeams = 100'000;
  constexpr float kTurn_rad = 2.01F * std::numbers::pi_v<float>;  // rounded
  return std::abs(message.angle_min) <= kTurn_rad && std::abs(message.angle_increment) <= kTurn_rad &&
         message.angle_increment != 0 && message.ranges.size() <= kMostBeams;
}

/// Messages that cannot be read are left out. Returns how many.
std::size_t each_scan(const fs::path& path, const std::string& topic,
                      const std::function<void(LaserScan&, std::int64_t)>& handle) {
  std::size_t left_out = 0;
  bag::BagHandlers handlers;
  handlers.wants = [&](const bag::BagTopic& at) { return at.name == topic && at.type == LaserScan::kType; };
  handlers.message = [&](const bag::BagTopic&, const bag::BagMessage& message) {
    std::optional<LaserScan> scan = ros2::decode<LaserScan>(message.data);
    if (scan && can_be_read(*scan))
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
  std::size_t kept = 0;
  const std::size_t left_out = each_scan(path, found.topic, [&](LaserScan& scan, std::int64_t) {
    stamps.take(stamp_ns(scan));
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
