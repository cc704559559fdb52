#pragma once

#include <optional>
#include <vector>

#include "host/film/camera/scene.hpp"

namespace astro::film {

/// A floor tag as it was seen while it lay there.
struct SeenFloorTag {
  int id = 0;
  TagCorners corners;
};

/// A first guess of the camera's pose and of the poses of the floor tags. Tries both planar poses of each of
/// the largest tags, for some focal lengths. Takes the pose on whose plane all tags come closest to squares
/// of one size, because one tag alone hardly shows which way it leans. The first tag given becomes the
/// origin.
///
/// Nothing if no pose has the camera above the floor and all tags in front of it.
/// Precondition  at least one tag.
std::optional<Scene> floor_start(const std::vector<SeenFloorTag>& tags, int width_px, int height_px,
                                 double floor_side_m);

}  // namespace astro::film
