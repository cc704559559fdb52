#pragma once

#include <filesystem>
#include <vector>

#include "host/film/track/film_track.hpp"

/// A film of a robot whose true path is known, which lies beside a developer's checkout only.
namespace astro::support {

/// "" if it is not there.
std::filesystem::path recorded_film();

/// What its user would state.
film::FilmFigures stated_figures();

struct TrueFrame {
  double pts_s, robot_time_s, x_m, y_m, theta_rad;
};
/// The true pose of the tag when the first row of each picture was exposed.
std::vector<TrueFrame> true_frames();

/// Found poses less true ones, after the similarity that fits best: positions' rms, headings' rms about their mean, the factor
/// less 1.
struct PoseErrors {
  double position_m = 0, heading_rad = 0, scale = 0;
  std::size_t compared = 0;
};
PoseErrors compare(const std::vector<film::FilmPose>& poses, const std::vector<TrueFrame>& frames);

}  // namespace astro::support
