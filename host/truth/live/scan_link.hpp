#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "host/lidar/scan.hpp"

namespace astro::truth {

/// What brings the scans of a laser scanner on the robot to this computer.
class ScanLink {
 public:
  ScanLink() = default;
  ScanLink(const ScanLink&) = delete;
  ScanLink& operator=(const ScanLink&) = delete;
  virtual ~ScanLink() = default;

  /// Waits up to `timeout`, and returns the scans that have come, their times on this computer's steady clock. Throws astro::Error if
  /// no more can come.
  virtual std::vector<lidar::Scan> poll(std::chrono::microseconds timeout) = 0;

  /// "the laser scanner at /dev/ttyUSB0"; may be called by another thread than the others.
  virtual std::string subject() const = 0;
  /// What may be wrong if no scan comes, as a question; likewise.
  virtual std::string doubt() const = 0;
  /// What it turned out to be: "RPLIDAR A1M8 at 115200 baud".
  virtual std::string description() const = 0;
};

}  // namespace astro::truth
