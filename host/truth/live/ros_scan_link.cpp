#include "host/truth/live/ros_scan_link.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/base/blocked_signals.hpp"
#include "host/base/environment.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/cdr/names.hpp"
#include "host/formats/cdr/type_description.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/live/dds/fast_dds.hpp"
#include "host/truth/scanners/laser_scan.hpp"

namespace astro::truth {
namespace {

using ros2::msg::LaserScan;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr dds::Qos kScansAsTheyCome{false, false, 100};
constexpr std::int64_t kClockListening_us =
    700'000;  // to choose between the two times, and to see the shortest delay
constexpr std::int64_t kTakeOver_us = 2'000'000;
constexpr std::size_t kMostScansHeld = 1024;
constexpr microseconds kTopicLook = milliseconds(50), kLongestTopicLook = milliseconds(2000);

microseconds this_computers_time() {
  return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
}

std::unique_ptr<dds::Participant> opened(const dds::Discovery& discovery) {
  const BlockedSignals blocked;
  return dds::open_fast_dds(discovery, "ground_truth", "enclave=/;");
}

double lasts_us(const lidar::Scan& scan) {
  return 1e6 * scan.beam_interval_s * static_cast<double>(scan.ranges_m.size());
}

}  // namespace

RosScanLink::RosScanLink(const TrackerUrl& url)
    : RosScanLink(url, dds::discovery_from(url.where, environment_variable)) {}

RosScanLink::RosScanLink(const TrackerUrl& url, const dds::Discovery& discovery)
    : topic_(url.topic), participant_(opened(discovery)) {
  const BlockedSignals blocked;
  reader_ = participant_->create_reader(
      {ros2::wire_name_of_topic(topic_), ros2::dds_type_name(LaserScan::kType), kScansAsTheyCome});
}

std::vector<lidar::Scan> RosScanLink::poll(microseconds timeout) {
  participant_->wait(timeout);
  const std::int64_t now_us = this_computers_time().count();
  for (const dds::Sample& sample : reader_->take()) take(sample, now_us);
  if (held_.empty()) return {};
  if (!clock_) {
    if (held_.back().stamp.arrival_us - held_.front().stamp.arrival_us < kClockListening_us) return {};
    std::vector<Stamp> stamps;
    for (const Heard& heard : held_) stamps.push_back(heard.stamp);
    clock_.emplace(stamps);
  }
  std::vector<lidar::Scan> scans;
  for (Heard& heard : std::exchange(held_, {})) {
    heard.scan.time_ns = 1000 * (clock_->host_time_us(heard.stamp) - std::llround(lasts_us(heard.scan)));
    if (heard.scan.time_ns <= last_ns_) continue;
    last_ns_ = heard.scan.time_ns;
    scans.push_back(std::move(heard.scan));
  }
  return scans;
}

/// Two scanners on one topic would be taken for one that leaps. The other is heard once the first has been silent.
bool RosScanLink::is_from_publisher(const dds::Sample& sample, std::int64_t now_us) {
  if (publisher_ && *publisher_ != sample.id.writer && now_us - heard_us_ < kTakeOver_us) return false;
  publisher_ = sample.id.writer;
  heard_us_ = now_us;
  return true;
}

void RosScanLink::take(const dds::Sample& sample, std::int64_t now_us) {
  if (!is_from_publisher(sample, now_us)) return;
  std::optional<LaserScan> message = ros2::decode<LaserScan>(sample.payload);
  std::optional<lidar::Scan> scan = message ? scan_in(std::move(*message)) : std::nullopt;
  if (!scan) return;
  const Stamp stamp{scan->time_ns / 1000, now_us};
  if (clock_ && !clock_->follows(stamp)) {  // the driver has restarted, or its clock was set
    clock_.reset();
    held_.clear();
  }
  if (held_.size() >= kMostScansHeld) held_.erase(held_.begin(), held_.begin() + kMostScansHeld / 2);
  held_.push_back({stamp, std::move(*scan)});
}

bool carries_scans(const TrackerUrl& url) {
  return carries_scans(url, dds::discovery_from(url.where, environment_variable));
}

bool carries_scans(const TrackerUrl& url, const dds::Discovery& discovery) {
  const auto participant = opened(discovery);
  const microseconds until = this_computers_time() + kLongestTopicLook;
  do {
    for (const dds::RemoteEndpoint& other : participant->remote_endpoints())
      if (other.writes && other.topic == ros2::wire_name_of_topic(url.topic))
        return other.type == ros2::dds_type_name(LaserScan::kType);
    participant->wait(kTopicLook);
  } while (this_computers_time() < until);
  return false;
}

}  // namespace astro::truth
