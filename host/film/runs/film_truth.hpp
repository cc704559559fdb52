#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/film/runs/run_placement.hpp"
#include "host/film/track/film_track.hpp"

/// Films as the ground truth of runs.
namespace astro::film {

/// Why a run cannot get truth from a film. Values: the name of the run.
enum class FilmedRunProblem { no_odometry };

/// A film that was followed, and its name in error messages.
struct NamedFilm {
  std::string name;
  film::FilmTrack track;
};

struct FilmReport {
  struct RunPlace {
    std::string run, film;
    Placement place;
    double from_s = 0, to_s = 0;  // in the film
  };
  std::vector<RunPlace> runs;
  double readout_s = 0;
  std::optional<double> readout_sigma_s;  // if it was found from the odometry
  double scale_sigma = 0;
  bool scale_measured = false;
  std::vector<Remark> remarks;
};

/// Replaces the truth of each run by the poses of the film that shows it, on the robot's clock to some 10 ms,
/// with a margin of 0.3 s at either end. A run is taken out of the set, and a remark says so, if no film
/// shows it, if the film shows less than half of it, or if the robot drives out of the picture. If
/// `readout_s` is empty, the camera's readout time is found from the odometry: with the right one, wheels and
/// film agree best.
///
/// Errors  astro::Error if no run is left, which says what the film does not show of the first one; and what
///         trajectories_of and calibration::estimate_ml throw while the readout time is searched for.
/// Cost    about ten calibrations.
FilmReport attach_films(experiment::RunSet& set, const std::vector<NamedFilm>& films,
                        std::optional<double> readout_s);

}  // namespace astro::film
