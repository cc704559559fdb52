#pragma once

#include <vector>

#include "host/film/camera/scene_fit.hpp"
#include "host/film/track/camera_motion.hpp"
#include "host/film/track/film_figures.hpp"
#include "host/film/track/film_sightings.hpp"

namespace astro::film {

/// The figures with the standard errors of a ruler. A side that nobody gave has its printed size with a
/// standard error of 5 %, or 30 % without `as_usual`; a height that nobody gave, one of 0.06 m or 0.3 m.
Figures figures_with_errors(const FilmFigures& given);

/// Finds the scene from all floor tags and at most 700 pictures of the robot, spread over places and
/// headings.
///
/// Errors  astro::Error if no place of the camera fits the floor tags.
SceneFit find_scene(const FilmInfo& info, const std::vector<SeenFloorTag>& floor,
                    const std::vector<RobotTagSeen>& robot, const FilmFigures& given);

}  // namespace astro::film
