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

/// Values: the name of the run.
enum class FilmedRunProblem { no_odometry };

/// A film that was followed, and what its errors call it.
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

/// Gives each run the poses of the film that shows it, on the robot's clock to some 10 ms, with a margin of 0.3 s at either end;
/// whatever truth it had is replaced. Runs that no film shows, of which it shows less than half, or in which the robot drives out of
/// the picture are taken out of the set, and a remark says so. The readout of the
/// camera is given, or found from the odometry: with the right one, wheels and film agree best.
///
/// Errors  astro::Error if no run is left, with what the film lacks of the first, and what trajectories_of and calibration::estimate_ml throw while the
///         readout is searched for.
/// Cost    about ten calibrations.
FilmReport attach_films(experiment::RunSet& set, const std::vector<NamedFilm>& films,
                        std::optional<double> readout_s);

}  // namespace astro::film
