#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "hal/sim/chassis.hpp"
#include "host/base/pose2.hpp"
#include "host/recording/run.hpp"
#include "host/simulation/robot/normal_deviates.hpp"

namespace astro::simulation {

struct MocapConfig {
  double rate_hz = 60;
  double position_sd_m = 0.0002;  // as stated by the maker of the thesis's cameras
  double heading_sd_rad = 0.001;
  std::uint64_t seed = 1;
  // The tracker's frame as seen from the simulated world's: an uncalibrated origin, as in any lab.
  Pose2 origin{1.25, -0.75, 0.4};
  // Where the tracked body sits on the robot: ahead and to the left of the point between the wheels.
  double ahead_m = 0, left_m = 0;
};

/// Eight cameras that see a simulated robot: the true pose at a fixed rate, in the tracker's own frame, with
/// white noise. Deterministic: the same seed and poses give the same samples.
class VirtualMocap {
 public:
  explicit VirtualMocap(const MocapConfig& config) : config_(config), random_(config.seed) {}

  /// Must be called once per millisecond; returns a sample when one is due.
  std::optional<recording::TruthSample> advance(std::uint64_t time_us, const sim::Pose& truth);

  /// Must be called when the robot's clock, which stamps the samples, has restarted at 0.
  void restart_clock() { due_us_ = 0; }

 private:
  MocapConfig config_;
  std::mt19937_64 random_;
  NormalDeviates normal_;
  double due_us_ = 0;
};

}  // namespace astro::simulation
