#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "host/lidar/scan.hpp"
#include "host/truth/scanners/rplidar_nodes.hpp"

namespace astro::truth::rplidar {

/// When a measurement was made, on this computer's clock, though none carries a time. Measurements follow one another at a
/// constant rate, and their bytes come late by what the scanner, the line and this computer's scheduler take:
///
///   arrival of the measurement n, counted from 0 = start + n period + delay,   delay >= 0
///
/// so the period is the slope of a line through the arrivals of the last seconds, and the start is where none of them comes early.
class SampleClock {
 public:
  /// `nominal_s`: the period by the scanner's own words; used until half a second has been seen, or if the slope is far from it.
  explicit SampleClock(double nominal_s) : nominal_s_(nominal_s), period_s_(nominal_s) {}

  /// The first `count` measurements had come by this time, and the last of them just then.
  void arrived(std::int64_t count, std::chrono::microseconds at);
  /// To be called where the counts no longer tell the time, because an unknown number of measurements was lost.
  void restart();
  /// Uses what has arrived from now on.
  void update();

  /// Whether anything is known of the times.
  bool started() const { return !arrivals_.empty(); }
  /// Whether enough has arrived that a single late arrival no longer matters: half a second.
  bool settled() const;

  double period_s() const { return period_s_; }
  /// When measurement `count`, counted from 0, was made. Precondition: something has arrived before the last update().
  double time_us(std::int64_t count) const {
    return start_us_ + 1e6 * period_s_ * static_cast<double>(count);
  }

 private:
  struct Arrival {
    std::int64_t count = 0;
    double time_us = 0;
  };

  double nominal_s_, period_s_;
  bool measured_ = false;  // the period, by arrivals
  double start_us_ = 0;
  std::deque<Arrival> arrivals_;
};

/// Makes a scan of each turn. Measurements are about evenly spaced, but a triangulating scanner corrects the angle of each by what
/// its range needs; a scan's beams are exactly evenly spaced. So each beam is laid onto the straight line between the two
/// measurements beside it, which on a wall is exact; where they do not lie on one surface it takes the nearer one if that is close
/// by, and else it says nothing.
class TurnAssembler {
 public:
  struct Range {
    double min_m = 0, max_m = 0;
  };

  /// `delay_s`: from a measurement to the last of its bytes, at least.
  TurnAssembler(double sample_s, double delay_s, Range range);

  /// Measurements in their order, with when the bytes of the first `received` of them had come.
  void add(const std::vector<Node>& nodes, std::int64_t received, std::chrono::microseconds at);

  /// The turns that have ended since the last call, in order of time. The time of a scan is on the clock of the arrivals. At the
  /// start, and after bytes were lost, the first ones wait until the clock has settled.
  std::vector<lidar::Scan> take();

 private:
  /// Its stamp is not known yet.
  struct Turn {
    std::int64_t count = 0;  // of its first measurement
    lidar::Scan scan;
  };

  void finish_turn();
  void stamp_turns();

  SampleClock clock_;
  double delay_s_;
  Range range_;
  std::vector<Node> turn_;
  bool whole_ = false;  // it began with the start of a turn, and nothing was lost since
  std::vector<Turn> ended_;
  std::vector<lidar::Scan> scans_;
  std::int64_t last_ns_ = std::numeric_limits<std::int64_t>::min();  // of the last scan
};

}  // namespace astro::truth::rplidar
