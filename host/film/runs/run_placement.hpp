#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host/film/track/film_poses.hpp"
#include "host/recording/run.hpp"

/// Where in a film runs are, by how fast the robot turns and drives in both.
namespace astro::film {

/// A moment's rates, both in m/s: half a turn a second to the left counts as 0.47 m/s; the speed has no sign.
struct MotionRate {
  float turn = 0, speed = 0;
  bool known = false;
};

/// Rates in equal steps of time: what a film and a robot's odometry have in common before their clocks are known.
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
  double all = 0;      // at most 1; a part of the run that the film does not show counts as unlike
  double visible = 0;  // of the part that the film shows
  double shown = 0;    // part of the run's motion that the film shows
};

/// How alike both are if the robot's time is the film's plus `offset_s`.
Likeness likeness(const MotionRates& run, const MotionRates& film, double offset_s);

/// Two places whose likenesses differ by less than this fit equally well.
inline constexpr double kRival = 0.02;

/// Where in a film a run is: robot's time = film's time + offset_s.
struct Placement {
  double offset_s = 0;
  Likeness likeness = {};  // of the rates there
  bool ambiguous = false;  // another place fits as well, and only the order of the runs decided
};

/// Places all runs in one film by sliding their rates along it. Runs that one clock of the robot timed one after the other share
/// one offset, so a square that is driven five times is not taken for another; where the clocks overlap (each log begins
/// at zero), each run is placed alone, and where several places fit, in the order of the runs.
///
/// `order`  of the runs in time, as far as it is known: indices of `runs`
/// Errors   none; a run that is not in the film has a likeness far below 1.
/// Cost     a minute of runs in an hour of film: 0.1 s.
std::vector<Placement> place_runs(std::span<const MotionRates> runs, const MotionRates& film,
                                  std::span<const std::size_t> order);

}  // namespace astro::film
