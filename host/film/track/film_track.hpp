#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/film/camera/figure_check.hpp"
#include "host/film/camera/film_poses.hpp"
#include "host/film/camera/scene.hpp"
#include "host/film/picture/film_info.hpp"
#include "host/film/track/camera_motion.hpp"
#include "host/film/track/film_figures.hpp"
#include "host/film/track/film_sightings.hpp"

/// Computes the robot's path from a film that shows a tag on the robot and tags on the floor.
namespace astro::film {

/// One floor tag as the film shows it.
struct FloorTagReport {
  int id = 0;
  double side_px = 0;     // its shortest side
  double seen_share = 0;  // of the looks at the floor
  double misfit_px = 0;   // rms residual of its corners, per coordinate
};

/// Where a film does not show the robot's tag, by the times of the pictures.
struct HiddenSpan {
  double from_s = 0, to_s = 0;
  /// The tag was last seen, or seen again, at the border of the picture. Otherwise something covers it.
  bool left_picture = false;
};

struct FilmTrack {
  FilmInfo info;
  FilmFigures figures;
  Scene scene;
  Eigen::MatrixXd covariance;  // of the scene's parameters
  /// The standard error of the common factor of all distances (camera/scale_error.hpp). If nobody measured a
  /// distance, it is that of tags printed in a size that nobody checked. It is larger if the measured values
  /// contradict each other.
  double scale_sigma = 0;
  /// Checks each value that a person measured against the film and all other measured values.
  std::vector<FigureCheck> checked;
  std::vector<FloorTagReport> floor;
  double floor_rms_px = 0;
  CameraMotion motion;
  FilmSightings sightings;  // with the corners that a camera at rest would have seen
  FilmPoses found;          // with the readout time in `figures`
  std::vector<HiddenSpan> hidden;
  std::vector<Remark> remarks;
  std::string fingerprint;  // identifies the film, whatever its name: a hash of what it shows
};

/// Follows the robot through the whole film.
///
/// Cost    about half the length of a 1080p30 film on one core, beside the decoder.
/// Memory  one picture, and some hundred bytes for each.
/// Errors  astro::Error that says what is wrong with the film: not a film, truncated, cut, no tag of the robot or of the floor,
///         a tag too small, blurred or mirrored, two robots, a camera that moves, lengths
///         that contradict each other; and what `progress` throws.
FilmTrack follow_film(const std::filesystem::path& film, const FilmFigures& figures,
                      const Progress& progress = {});

}  // namespace astro::film
