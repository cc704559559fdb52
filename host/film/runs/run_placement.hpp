#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host/film/camera/film_poses.hpp"
#include "host/recording/run.hpp"

/// Finds where in a film each run is, by how fast the robot turns and drives in both.
namespace astro::film {

/// The rates of motion at one moment, both in m/s. A turn rate counts as the speed at an arm of 0.15 m: half
/// a turn a second to the left is 0.47 m/s. The speed has no sign.
struct MotionRate {
  float turn = 0, speed = 0;
  bool known = false;
};

/// Rates in equal time steps. A film and a robot's odometry can be compared by them before the clock offset
/// is known.
struct MotionRates {
  double first_s = 0;
  std::vector<MotionRate> bins;
  static constexpr double kBin_s = 0.05;

  double end_s() const { return first_s + kBin_s * static_cast<double>(bins.size()); }
};

/// The rates of a film, by its own times; unknown where the tag was hidden.
MotionRates rates_of(const std::vector<film::FilmPose>& poses);

/// The rates of a run, by the robot's times in seconds.
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

/// Places all runs in one film by sliding their rates along it. If the runs follow each other on one clock of
/// the robot, they share one offset, so that five runs of the same square are not confused. If their times
/// overlap (because each log begins at zero), or one offset fits badly, each run is placed alone; if several
/// places fit, the order of the runs decides.
///
/// `order`  of the runs in time, as far as it is known: indices of `runs`
/// Errors   none; a run that is not in the film has a likeness far below 1.
/// Cost     a minute of runs in an hour of film: 0.1 s.
std::vector<Placement> place_runs(std::span<const MotionRates> runs, const MotionRates& film,
                                  std::span<const std::size_t> order);

}  // namespace astro::film
