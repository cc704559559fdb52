#pragma once

#include <filesystem>

#include "host/film/track/film_figures.hpp"
#include "tests/support/base/places.hpp"

namespace astro::support {

/// A film of a robot whose true path is known, and what was recorded with it: beside a developer's checkout only.
inline std::filesystem::path camera_data() { return shared_data() / "camera"; }

inline std::filesystem::path recorded_film() { return camera_data() / "dev.mp4"; }

/// The sizes of its tags and a tape, as its user would state them. The readout time is not among them.
inline film::FilmFigures stated_figures() {
  film::FilmFigures figures;
  figures.floor_side_m = 0.160;
  figures.robot_side_m = 0.1201;
  figures.robot_height_m = 0.121;
  figures.tapes = {{1, 4, 3.460}};
  return figures;
}

}  // namespace astro::support
