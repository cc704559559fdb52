#pragma once

#include "host/calibration/motion/motion_match.hpp"
#include "host/calibration/motion/motion_profile.hpp"
#include "host/calibration/motion/trajectory.hpp"

/// Both streams of one run as speeds, averaged over a window long enough to suppress the tracker's noise.
namespace astro::calibration {

class RecordedMotion {
 public:
  /// `lever_m`: assumed distance of the tracked body ahead of the centre. `run` must outlive this.
  RecordedMotion(const Trajectory& run, double wheelbase_m, double lever_m);

  /// The window of one speed: a fifth of a second, or longer if the tracker's noise would otherwise exceed a
  /// fifth of the variation of the wheels' speed: 0.9 s for 5 cm at 60 Hz.
  const Window& window() const { return window_; }

  /// The smallest bins that are worth comparing: a twentieth of a second, or longer if a single wrong time makes the
  /// recording so long that they would not fit into memory.
  double finest_bin_s() const;

  /// The speeds of each stream. Bins much coarser than the window use speeds averaged over a bin.
  MotionProfile wheels(double bin_s) const;
  MotionProfile truth(double bin_s) const;
  MotionMatch match(double bin_s) const;

  double wheel_middle_s() const { return (run_.wheels.front().time_s + run_.wheels.back().time_s) / 2; }
  double truth_middle_s() const { return (run_.truth.front().time_s + run_.truth.back().time_s) / 2; }
  double wheel_span_s() const { return run_.wheels.back().time_s - run_.wheels.front().time_s; }
  double truth_span_s() const { return run_.truth.back().time_s - run_.truth.front().time_s; }

 private:
  Window window_for(double bin_s) const;
  void choose_window();
  double noise_mps(const Window& window) const;

  const Trajectory& run_;
  bool headings_;
  double radius_m_;  // of a wheel about the centre; 0 without headings, so that turning does not count
  BodyPath wheel_path_, truth_path_;
  double sigma_m_ = 0, truth_rate_hz_ = 0;
  Window window_;
};

}  // namespace astro::calibration
