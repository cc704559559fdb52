#pragma once

#include <vector>

#include "host/film/camera/scene_fit.hpp"
#include "host/film/track/camera_motion.hpp"
#include "host/film/track/film_figures.hpp"
#include "host/film/track/film_sightings.hpp"

namespace astro::film {

/// The figures with the standard errors of a ruler. Those that nobody gave have the printed sizes, with standard errors so
/// large that they decide nothing.
Figures figures_with_errors(const FilmFigures& given);

/// The scene that all floor tags and no more than 700 pictures of the robot show, spread over places and headings.
///
/// Errors  astro::Error if no place of the camera fits the floor tags.
SceneFit find_scene(const FilmInfo& info, const std::vector<SeenFloorTag>& floor,
                    const std::vector<RobotTagSeen>& robot, const FilmFigures& given);

}  // namespace astro::film
