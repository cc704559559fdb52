#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/simulation/server/virtual_rplidar.hpp"
#include "host/truth/scanners/rplidar_driver.hpp"

namespace astro::truth::rplidar {

/// A virtual RPLIDAR in a room, in virtual time, with what can go wrong at its line.
struct ScannerOnDesk {
  static simulation::ScannerConfig exact(int beams) {
    simulation::ScannerConfig config;
    config.range_sd = config.least_sd_m = config.missing = 0;
    config.beams = beams;
    return config;
  }

  explicit ScannerOnDesk(const simulation::RplidarConfig& config = {},
                         const simulation::ScannerConfig& scanner = exact(360))
      : eye(simulation::rectangular_room({-2, -1.5}, {4, 3}), scanner), device(config, scanner) {}

  /// How far a point is from the walls of the room.
  static double off_walls_m(const Point2& p) {
    return std::min({std::abs(p.x_m + 2), std::abs(p.x_m - 4), std::abs(p.y_m + 1.5), std::abs(p.y_m - 3)});
  }

  void step() {
    now_us += 1000;
    if (motor_turns) {
      eye.advance(static_cast<std::uint64_t>(now_us), robot);
      device.measure(eye.beams());
    }
    for (const lidar::Scan& scan : eye.take_scans()) scans.push_back(scan);
    std::uint8_t byte = 0;
    while (device.transmit({&byte, 1}) != 0) on_line.push_back(through_line(byte));
    if (now_us % burst_us == 0) {
      append(at_host, on_line);
      on_line.clear();
    }
  }

  std::uint8_t through_line(std::uint8_t byte) {
    ++passed;
    const bool wrong = baud != right_baud || (damage_every != 0 && passed % damage_every == 0);
    return static_cast<std::uint8_t>(wrong ? byte * 37 + 101 : byte);
  }

  simulation::VirtualScanner eye;
  simulation::VirtualRplidar device;
  Pose2 robot{0.3, 0.2, 0.5};
  std::vector<lidar::Scan> scans;  // as the scanner made them, on the same clock
  std::int64_t now_us = 0;
  bool motor_turns = true, has_power = true, plugged = true, dtr_runs_motor = false;
  unsigned baud = 0, right_baud = 115'200;
  std::int64_t burst_us = 1000;  // the adapter passes bytes on this often
  unsigned most_late_ms = 0;     // the computer looks at bytes that have come so much later, at random
  std::mt19937 random{17};
  std::uint64_t damage_every = 0, passed = 0;
  Bytes on_line, at_host;
};

class LineOnDesk : public Line {
 public:
  explicit LineOnDesk(std::shared_ptr<ScannerOnDesk> desk) : desk_(std::move(desk)) {}

  void open(unsigned baud) override {
    desk_->baud = baud;
    desk_->at_host.clear();
  }
  void write(ByteView bytes) override {
    require_plugged();
    if (desk_->has_power && desk_->baud == desk_->right_baud) desk_->device.receive(bytes);
  }
  std::size_t read(std::span<std::uint8_t> into, std::chrono::microseconds timeout) override {
    const std::int64_t until_us = desk_->now_us + timeout.count();
    while (desk_->at_host.empty() && desk_->now_us < until_us) desk_->step();
    require_plugged();
    const std::size_t count = std::min(into.size(), desk_->at_host.size());
    std::copy_n(desk_->at_host.begin(), count, into.begin());
    desk_->at_host.erase(desk_->at_host.begin(), desk_->at_host.begin() + static_cast<std::ptrdiff_t>(count));
    for (auto late_ms = desk_->random() % (desk_->most_late_ms + 1); late_ms > 0; --late_ms) desk_->step();
    return count;
  }
  void run_motor(bool on) override { desk_->dtr_runs_motor = on; }
  std::chrono::microseconds now() const override { return std::chrono::microseconds(desk_->now_us); }
  const std::string& name() const override { return name_; }

 private:
  void require_plugged() const {
    if (!desk_->plugged) throw Error("unplugged", ScannerProblem::unplugged, {name_});
  }

  std::shared_ptr<ScannerOnDesk> desk_;
  std::string name_ = "/dev/scanner";
};

}  // namespace astro::truth::rplidar
