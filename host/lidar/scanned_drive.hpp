#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"
#include "host/lidar/scan.hpp"

/// A drive of which the wheels and the scans of a scanner on the robot were recorded.
namespace astro::lidar {

/// Passes scans on, in order of time.
using ScanHandler = std::function<void(const Scan&)>;

struct ScannedDrive {
  std::string name;
  /// At least two samples; seconds since `origin_ns`, which is on the scans' clock, too, but for an offset that is found.
  std::vector<calibration::WheelSample> wheels;
  std::int64_t origin_ns = 0;
  /// Reads all scans from the first one on, each time that it is called, so that never more than a few are in memory.
  std::function<void(const ScanHandler&)> read_scans;
  /// Whether the times of wheels and scans are measured. If not, they only say which samples and scans follow each other.
  bool times_measured = true;
  std::vector<calibration::Slip> slips = {};  // that are known; on the clock of the wheels

  /// In whole seconds and the rest, because the difference of two odd times may be no std::int64_t.
  double seconds(const Scan& scan) const {
    constexpr std::int64_t kSecond_ns = 1'000'000'000;
    return static_cast<double>(scan.time_ns / kSecond_ns - origin_ns / kSecond_ns) +
           1e-9 * static_cast<double>(scan.time_ns % kSecond_ns - origin_ns % kSecond_ns);
  }
};

}  // namespace astro::lidar
