#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/live/dds/participant.hpp"
#include "host/truth/live/scan_link.hpp"
#include "host/truth/live/stamps.hpp"
#include "host/truth/live/tracker_url.hpp"

namespace astro::truth {

/// A topic of ROS 2 with scans (sensor_msgs/msg/LaserScan), over DDS. It subscribes with best effort, which publishers of both
/// reliabilities serve.
///
/// Times  the stamps of the messages, or when they come if these are far more regular (stamps.hpp). A scan comes once it is whole, so
///        that its first beam is earlier by what the scan takes. The calibration finds the rest of the delay.
class RosScanLink : public ScanLink {
 public:
  /// Uses the domain and range that the URL names, or else the environment. Throws astro::Error if these are impossible.
  explicit RosScanLink(const TrackerUrl& url);
  RosScanLink(const TrackerUrl& url, const dds::Discovery& discovery);

  std::vector<lidar::Scan> poll(std::chrono::microseconds timeout) override;
  std::string subject() const override { return "the laser scanner that publishes " + topic_; }
  std::string doubt() const override { return "does its driver still run?"; }
  std::string description() const override { return topic_ + " of ROS 2"; }

 private:
  struct Heard {
    Stamp stamp;
    lidar::Scan scan;
  };

  bool is_from_publisher(const dds::Sample& sample, std::int64_t now_us);
  void take(const dds::Sample& sample, std::int64_t now_us);

  std::string topic_;
  std::unique_ptr<dds::Participant> participant_;  // before its reader
  std::unique_ptr<dds::Reader> reader_;
  std::optional<TrackerClock> clock_;
  std::vector<Heard> held_;  // until the clock is known
  std::optional<dds::Guid> publisher_;
  std::int64_t heard_us_ = 0;  // from it, on this computer's clock
  std::int64_t last_ns_ = 0;   // of the scans that were given
};

/// Whether a topic of ROS 2 carries scans. Waits up to two seconds for somebody who publishes it. Throws as RosScanLink.
bool carries_scans(const TrackerUrl& url);
bool carries_scans(const TrackerUrl& url, const dds::Discovery& discovery);

}  // namespace astro::truth
