#pragma once

#include "host/calibration/clock/motion_match.hpp"
#include "host/calibration/clock/motion_profile.hpp"
#include "host/calibration/motion/trajectory.hpp"

/// Both streams of one run as motions, told over as long as the tracker's noise asks for.
namespace astro::calibration {

class RecordedMotion {
 public:
  /// `lever_m`: how far ahead of the centre the tracked body is thought to be. `run` must outlive this.
  RecordedMotion(const Trajectory& run, double wheelbase_m, double lever_m);

  /// Time over which one speed is taken: a fifth of a second, or more where the tracker's noise would
  /// otherwise be more than a fifth of how the wheels' speed varies: 0.9 s for 5 cm at 60 Hz.
  const Window& window() const { return window_; }

  /// Bins much coarser than the window see motions told over a bin.
  MotionMatch match(double bin_s) const;

  double wheel_middle_s() const { return (run_.wheels.front().time_s + run_.wheels.back().time_s) / 2; }
  double truth_middle_s() const { return (run_.truth.front().time_s + run_.truth.back().time_s) / 2; }
  double wheel_span_s() const { return run_.wheels.back().time_s - run_.wheels.front().time_s; }
  double truth_span_s() const { return run_.truth.back().time_s - run_.truth.front().time_s; }

 private:
  MotionProfile wheel_profile(double bin_s, const Window& window) const;
  void choose_window();
  double noise_mps(const Window& window) const;

  const Trajectory& run_;
  bool headings_;
  double radius_m_;  // of a wheel about the centre; 0 without headings: then turning is no motion
  BodyPath wheels_, truth_;
  double sigma_m_ = 0, truth_rate_hz_ = 0;
  Window window_;
};

}  // namespace astro::calibration
