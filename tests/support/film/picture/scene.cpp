#include "tests/support/film/picture/scene.hpp"

#include <Eigen/Geometry>

namespace astro::support::film {

using Eigen::Vector3d;

Patch FilmedRobot::tag_patch_at(double time_s) const {
  const FloorPose tag = tag_at(time_s);
  return tag_patch(paper, tag.x_m, tag.y_m, height_m, tag.theta_rad, tilt_x_rad, tilt_y_rad);
}

std::vector<Patch> FilmedRobot::patches_at(double time_s) const {
  const FloorPose body = track.at(time_s);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(body.theta_rad, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d place(body.x_m, body.y_m, 0), x = turn.col(0), y = turn.col(1), z = Vector3d::UnitZ();
  const double length = length_m / 2, width = width_m / 2, height = lid_m - floor_gap_m;
  const auto side = [&](const Vector3d& out, const Vector3d& along, double distance_m, double half_m,
                        float grey) {
    return Patch{place + out * distance_m + z * floor_gap_m, along, z, -half_m, half_m, 0, height, grey};
  };
  return {tag_patch_at(time_s),
          Patch{place + z * lid_m, x, y, -length, length, -width, width, 0.22F},
          side(x, y, length, width, 0.14F),
          side(-x, -y, length, width, 0.10F),
          side(y, -x, width, length, 0.17F),
          side(-y, x, width, length, 0.12F)};
}

}  // namespace astro::support::film
