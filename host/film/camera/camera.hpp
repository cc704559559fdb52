#pragma once

#include <Eigen/Core>
#include <optional>

namespace astro::film {

/// A pinhole camera with radial distortion, above a floor.
///
/// Frames  floor: z up, the floor at z = 0, metres. Camera: x to the right of the picture, y down it, z into it.
/// Model   p = R (P - position), x = p.x / p.z, y = p.y / p.z, r2 = x^2 + y^2, d = 1 + k1 r2 + k2 r2^2,
///         u = f x d + cx, v = f y d + cy. Pixel centres are integers. There are no tangential terms,
///         because a film of one plane cannot distinguish them from a tilt of the floor.
struct Camera {
  double f_px = 0, cx_px = 0, cy_px = 0, k1 = 0, k2 = 0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // floor to camera
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

/// Projects a point to its pixel. Precondition: the point is in front of the camera.
Eigen::Vector2d project(const Camera& camera, const Eigen::Vector3d& point_m);

/// The point at height `z_m` above the floor that a pixel shows; nothing if the ray does not meet that plane in front of the
/// camera, or if the distortion cannot be undone there.
std::optional<Eigen::Vector2d> on_plane(const Camera& camera, const Eigen::Vector2d& pixel, double z_m);

/// The rotation by the vector `turn` (axis times angle, rad).
Eigen::Matrix3d rotation_by(const Eigen::Vector3d& turn_rad);

}  // namespace astro::film
