#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "host/film/track/film_track.hpp"

namespace astro::film {

/// A PNG of the film's first picture with the floor tags (green, with their numbers), the robot's tag at that
/// moment (red) and the path of the robot's tag through the whole film (blue), drawn where the scene puts
/// them.
///
/// Errors  those of FrameStream.
std::vector<std::uint8_t> preview_png(const std::filesystem::path& film, const FilmTrack& track);

}  // namespace astro::film
