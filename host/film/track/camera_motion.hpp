#pragma once

#include <optional>
#include <vector>

#include "host/film/picture/tag_corners.hpp"

namespace astro::film {

/// Where the floor tags are seen at a moment; nothing for one that is hidden.
struct FloorLook {
  double pts_s = 0;
  std::vector<std::optional<TagCorners>> tags;  // in the order of the scene's tags
};

/// How far the picture has moved from its mean position over the film: the shift, in pixels, of things that do not move.
struct PictureMotion {
  double pts_s = 0;
  Eigen::Vector2d shift_px{0, 0};   // at `about_px`
  double turn_rad = 0, growth = 0;  // about that point
  Eigen::Vector2d about_px{0, 0};

  Eigen::Vector2d at(const Eigen::Vector2d& pixel) const;
};

/// The floor tags over a whole film: where they are on average, and how the picture moved relative to that.
struct CameraMotion {
  std::vector<TagCorners> means;      // of each tag
  std::vector<std::size_t> seen;      // in how many pictures
  std::vector<PictureMotion> course;  // smoothed; empty if the floor was seen in too few pictures
  double most_px = 0;                 // largest smoothed shift, relative to the beginning
  double most_at_s = 0;               // when it was half that far for the first time
  double shake_px = 0;                // rms of what smoothing removes

  /// The corners as a camera at rest would have seen them.
  TagCorners steadied(double pts_s, const TagCorners& corners) const;
};

/// Measures the motion of the camera, so that a slow sag can be removed from the corners. The caller judges
/// whether the motion is small enough for that.
///
/// `start`  approximate corners, used for tags that no picture of the floor shows
CameraMotion camera_motion(const std::vector<FloorLook>& looks, const std::vector<TagCorners>& start);

}  // namespace astro::film
