#pragma once

#include <cstddef>
#include <vector>

#include "host/recording/run/run.hpp"
#include "host/truth/film/track/film_poses.hpp"

/// What a film and a robot's odometry have in common before their clocks are known: how fast the robot turns and drives.
namespace astro::experiment {

/// A moment's rates, both in m/s and without sign: half a turn a second counts as 0.47 m/s.
struct MotionRate {
  float turn = 0, speed = 0;
  bool known = false;
};

/// Rates in equal steps of time.
struct MotionRates {
  double first_s = 0;
  std::vector<MotionRate> bins;
  static constexpr double kBin_s = 0.05;

  double end_s() const { return first_s + kBin_s * static_cast<double>(bins.size()); }
};

/// Of a film, by its own times. Unknown where the tag was hidden.
MotionRates rates_of(const std::vector<film::FilmPose>& poses);

/// Of a run, by the robot's times in seconds.
MotionRates rates_of(const recording::Run& run);

/// How alike both are if the robot's time is the film's plus `offset_s`: at most 1. What of the run the film does not show counts
/// as unlike.
double likeness(const MotionRates& run, const MotionRates& film, double offset_s);

}  // namespace astro::experiment
