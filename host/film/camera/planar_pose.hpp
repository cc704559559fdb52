#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "host/film/picture/tag_corners.hpp"

namespace astro::film {

/// A square's pose in the camera frame: point in camera = rotation * (point on the square, 0) + translation.
struct PlanarPose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation_m;
};

/// The two poses of a square with sides of `side_m` that explain its corners almost equally well: a small
/// square hardly shows whether it leans towards the camera or away from it. The pose that fits better is the
/// first. The camera has no distortion.
///
/// `corners`  on the camera's plane z = 1: ((u - cx) / f, (v - cy) / f)
/// Source     Collins, Bartoli, Infinitesimal plane-based pose estimation, IJCV 109 (2014), section 4.
std::optional<std::array<PlanarPose, 2>> planar_poses(const TagCorners& corners, double side_m);

}  // namespace astro::film
