#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/lidar/scan.hpp"
#include "host/simulation/robot/normal_deviates.hpp"
#include "host/simulation/room/ray_caster.hpp"

namespace astro::simulation {

/// A laser scanner on a simulated robot; the defaults are a Slamtec RPLIDAR A1 (A1M8) that is mounted as it should be.
///
/// Source  data sheet of the A1M8: 0.15 to 12 m, 5.5 Hz with 360 samples a turn, resolution below 0.5 mm up to 1.5 m and below
///         1 % of the distance everywhere. It states no noise; we take its 1 % as two standard deviations.
struct ScannerConfig {
  Pose2 mount{};             // the scanner's frame on the robot
  bool upside_down = false;  // turned about the x axis of that frame
  bool clockwise = true;     // the way it turns, seen from its top
  double turns_per_s = 5.5;
  int beams = 360;  // a turn
  double range_min_m = 0.15, range_max_m = 12;
  double range_sd = 0.005;     // standard deviation of a range over that range ...
  double least_sd_m = 0.0005;  // ... but at least this
  double missing = 0.01;       // share of the beams of which nothing comes back, at random
  std::uint64_t seed = 1;
};

/// A scanner that turns while its robot drives: each beam leaves at its own time, from where the scanner is then. Deterministic.
class VirtualScanner {
 public:
  struct Beam {
    double time_us = 0;  // on the robot's clock
    int index = 0;       // within the turn
    float range_m = 0;   // NaN: nothing came back from within its range
  };

  /// Throws astro::Error if the configuration is of no scanner: no beams, or a rate, a range or a share that is impossible.
  VirtualScanner(const Room& room, const ScannerConfig& config);

  /// To be called in order of time, at least every few milliseconds, with the robot's true pose: between two calls the robot moves
  /// evenly.
  void advance(std::uint64_t time_us, const Pose2& robot);

  /// The beams since the call of advance() before the last one.
  const std::vector<Beam>& beams() const { return beams_; }

  /// The turns that have ended since the last call; of those that nobody takes, the newest some hundred are kept.
  std::vector<lidar::Scan> take_scans();

  /// To be called when the robot's clock has restarted at 0. The turn under way is lost.
  void restart_clock();

  const ScannerConfig& config() const { return config_; }
  /// To the next beam in the scanner's frame; negative if it turns clockwise. The first beam of a turn looks along x.
  double angle_step_rad() const;

 private:
  struct Moment {
    double time_us = 0;
    Pose2 robot;
  };

  Beam shoot(double time_us, const Pose2& robot);
  void keep(const Beam& beam);

  ScannerConfig config_;
  RayCaster rays_;
  std::mt19937_64 random_;
  NormalDeviates normal_;
  std::optional<Moment> last_;
  double beam_us_;       // between two beams
  double first_us_ = 0;  // the time of beam 0 of this turn
  int index_ = 0;        // of the next beam
  std::vector<Beam> beams_;
  lidar::Scan turn_;  // under way
  std::vector<lidar::Scan> scans_;
};

}  // namespace astro::simulation
