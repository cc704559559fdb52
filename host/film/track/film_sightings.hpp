#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/film/camera/film_poses.hpp"
#include "host/film/track/camera_motion.hpp"
#include "host/film/track/floor_survey.hpp"

namespace astro::film {

/// What all pictures of a film show, one after the other.
struct FilmSightings {
  std::vector<RobotTagSeen> robot;
  std::vector<FloorLook> looks;
  std::size_t pictures = 0;
  std::size_t unordered =
      0;  // pictures less than a millisecond later than the one before, which were left out
  double first_s = 0, last_s = 0;
  double longest_gap_s = 0, gap_at_s = 0;  // between two pictures
  std::optional<double> two_robots_s;
  std::string complaint;  // of the decoder; "" if it had none
};

/// Cost    about 10 ms for each picture of 1080p, and decoding it in another process.
/// Memory  one picture, and 100 bytes for each.
/// Errors  those of FrameStream, and what `progress` throws.
FilmSightings watch_film(const std::filesystem::path& film, const FilmInfo& info, int robot_id,
                         const FloorSurvey& survey, const Progress& progress);

}  // namespace astro::film
