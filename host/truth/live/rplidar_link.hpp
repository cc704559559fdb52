#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/truth/live/scan_link.hpp"
#include "host/truth/scanners/rplidar_driver.hpp"

namespace astro::truth {

/// An RPLIDAR at a serial port of this computer. The constructor throws as rplidar::Driver does.
class RplidarLink : public ScanLink {
 public:
  explicit RplidarLink(const std::string& port);
  /// Over any line whose clock is this computer's steady clock.
  explicit RplidarLink(std::unique_ptr<rplidar::Line> line);

  std::vector<lidar::Scan> poll(std::chrono::microseconds timeout) override { return driver_.poll(timeout); }
  std::string subject() const override { return "the laser scanner at " + port_; }
  std::string doubt() const override { return "does its motor turn?"; }
  std::string description() const override;

 private:
  std::string port_;
  rplidar::Driver driver_;
};

}  // namespace astro::truth
