#pragma once

#include <string>
#include <vector>

#include "host/commands/shared/robot_view.hpp"
#include "host/film/track/film_track.hpp"

namespace astro::commands {

/// The results from a film, one row each: a name and its value.
std::vector<std::vector<std::string>> film_table(const film::FilmTrack& track);

/// The same for people and as JSON.
std::string film_text(const film::FilmTrack& track);
Json to_json(const film::FilmTrack& track);

/// The poses as a table: pts_s,time_s,x_m,y_m,theta_rad, standard errors, misfit.
std::string film_csv(const film::FilmPoses& found);

/// The same as TUM: time x y z qx qy qz qw.
std::string film_tum(const film::FilmPoses& found, double height_m);

}  // namespace astro::commands
