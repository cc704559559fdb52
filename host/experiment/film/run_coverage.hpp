#pragma once

#include <optional>
#include <string>

#include "host/base/remedy.hpp"
#include "host/recording/run/run.hpp"
#include "host/truth/film/track/film_track.hpp"

/// How much of a run a film shows, once it is known where in the film the run is.
namespace astro::experiment {

/// A run's first and last moment, by the film's time.
struct RunWindow {
  double from_s = 0, to_s = 0;
};
RunWindow window_of(const recording::Run& run, double offset_s);

/// What of a run a film does not show.
struct Lack {
  std::string what;  // "the film ends 3.0 s before it"
  Help help = Help::film_whole_field;
  bool left_picture = false;  // the robot drove out of the picture
};

/// The worst that lasts longer than a second. Nothing if all is there.
std::optional<Lack> lack_of(const RunWindow& run, const film::FilmTrack& track);

}  // namespace astro::experiment
