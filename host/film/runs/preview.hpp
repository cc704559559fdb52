#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "host/film/track/film_track.hpp"

namespace astro::film {

/// The first picture of the film with the floor tags (green, with their numbers), the robot's tag where it is then (red), and the
/// path of the robot's tag all through the film (blue), as the scene has them: as PNG.
///
/// Errors  those of FrameStream.
std::vector<std::uint8_t> preview_png(const std::filesystem::path& film, const FilmTrack& track);

}  // namespace astro::film
