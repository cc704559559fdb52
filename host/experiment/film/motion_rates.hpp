#pragma once

#include <cstddef>
#include <vector>

#include "host/recording/run/run.hpp"
#include "host/truth/film/track/film_poses.hpp"

/// What a film and a robot's odometry have in common before their clocks are known: how fast the robot turns and drives.
namespace astro::experiment {

/// A moment's rates, both in m/s: half a turn a second to the left counts as 0.47 m/s; the speed has no sign.
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

struct Likeness {
  double all = 0;      // at most 1; what of the run the film does not show counts as unlike
  double visible = 0;  // of what the film shows
  double shown = 0;    // part of the run's motion that the film shows
};

/// How alike both are if the robot's time is the film's plus `offset_s`.
Likeness likeness(const MotionRates& run, const MotionRates& film, double offset_s);

}  // namespace astro::experiment
