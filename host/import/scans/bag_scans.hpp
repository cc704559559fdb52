#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/formats/files/bag.hpp"
#include "host/lidar/scanned_drive.hpp"

/// Scans of a laser scanner (sensor_msgs/msg/LaserScan) in bags.
namespace astro::importing {

struct BagScans {
  std::string topic;
  /// Reads the bag again. Times are header.stamp, or the recorder's if most messages have no stamp.
  std::function<void(const lidar::ScanHandler&)> read;
  std::vector<Remark> remarks;  // what was inferred or left out
};

/// topic: "" for the only one that has scans.
/// Throws astro::Error if no topic has scans; with the names of the topics if several have, or the named one has none; and what
/// bag::read_bag throws.
BagScans scans_in_bag(const std::filesystem::path& path, const std::string& topic = {});

/// The names of the topics that hold scans.
std::vector<std::string> scan_topics(const std::vector<bag::BagTopic>& topics);

/// Whether a bag has scans but no poses that are recognised as ground truth.
bool has_scans_alone(const std::filesystem::path& path);

}  // namespace astro::importing
