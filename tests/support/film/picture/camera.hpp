#pragma once

#include <Eigen/Core>

#include "tests/support/film/picture/lens.hpp"

/// Where a camera stands. World: z up, metres, the floor is z = 0. Camera: x right, y down, z forward.
namespace astro::support::film {

struct Camera {
  Eigen::Vector3d position_m = Eigen::Vector3d(0, 0, 2);
  Eigen::Matrix3d world_to_camera = Eigen::Matrix3d::Identity();
};

/// Looks from a place at another; the top of the picture is on the side of the world's +y. `roll_rad` turns the camera about its
/// axis, clockwise as it looks. Precondition: it does not look along +-y.
Camera looking_at(const Eigen::Vector3d& position_m, const Eigen::Vector3d& target_m, double roll_rad = 0);

/// The same camera, turned in its own frame: about its x axis (positive: the picture moves down, the camera looks up), its y axis
/// (positive: the picture moves left) and its z axis.
Camera turned(const Camera& camera, double about_x_rad, double about_y_rad, double about_z_rad = 0);

/// Precondition: the point is before the camera.
Pixel seen_at(const Lens& lens, const Camera& camera, const Eigen::Vector3d& point_m);

}  // namespace astro::support::film
