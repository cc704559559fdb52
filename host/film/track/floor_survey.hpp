#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "host/film/camera/floor_start.hpp"
#include "host/film/picture/film_info.hpp"
#include "host/film/picture/tag_corners.hpp"

namespace astro::film {

/// Called now and then with the part of the work that is done, 0 to 1. May throw to end the work.
using Progress = std::function<void(double)>;

/// What the key pictures of a film show.
struct FloorSurvey {
  std::vector<SeenFloorTag> floor;  // tags that lie still, by id
  struct Seen {
    double pts_s;
    TagCorners corners;
  };
  std::vector<Seen> robot;
  std::vector<int> moving;             // other tags that move
  std::optional<double> two_robots_s;  // when the robot's id was at two places
  std::size_t pictures = 0;
};

/// Looks at no more than about forty key pictures, each as a whole and in full resolution, because a far floor tag has few pixels.
///
/// Cost    0.2 s for each picture of 1080p.
/// Errors  those of FrameStream.
FloorSurvey survey_floor(const std::filesystem::path& film, const FilmInfo& info, int robot_id,
                         const Progress& progress);

}  // namespace astro::film
