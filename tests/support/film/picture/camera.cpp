#include "tests/support/film/picture/camera.hpp"

#include <Eigen/Geometry>

namespace astro::support::film {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

Camera looking_at(const Vector3d& position_m, const Vector3d& target_m, double roll_rad) {
  const Vector3d forward = (target_m - position_m).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitY()).normalized();
  Camera camera{position_m, {}};
  camera.world_to_camera.row(0) = right;
  camera.world_to_camera.row(1) = forward.cross(right);
  camera.world_to_camera.row(2) = forward;
  return turned(camera, 0, 0, roll_rad);
}

Camera turned(const Camera& camera, double about_x_rad, double about_y_rad, double about_z_rad) {
  // The camera turns one way, what it sees the other.
  const Eigen::Matrix3d turn =
      (AngleAxisd(-about_x_rad, Vector3d::UnitX()) * AngleAxisd(-about_y_rad, Vector3d::UnitY()) *
       AngleAxisd(-about_z_rad, Vector3d::UnitZ()))
          .toRotationMatrix();
  return {camera.position_m, turn * camera.world_to_camera};
}

Pixel seen_at(const Lens& lens, const Camera& camera, const Vector3d& point_m) {
  const Vector3d seen = camera.world_to_camera * (point_m - camera.position_m);
  return seen_at(lens, Ray{seen.x() / seen.z(), seen.y() / seen.z()});
}

}  // namespace astro::support::film
