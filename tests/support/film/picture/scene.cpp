#include "tests/support/film/picture/scene.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace astro::support::film {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TagPaper::TagPaper(int id, double side_m, double margin_cells, bool mirrored)
    : id_(id),
      side_m_(side_m),
      half_paper_m_(side_m / 2 + side_m / ::astro::film::paper::kCells * margin_cells),
      per_side_(static_cast<float>(1 / side_m)) {
  const ::astro::film::paper::TagPicture picture = ::astro::film::paper::tag_picture(id);
  for (int row = 0; row < ::astro::film::paper::kCells; ++row)
    for (int column = 0; column < ::astro::film::paper::kCells; ++column)
      white_[static_cast<std::size_t>(row * ::astro::film::paper::kCells + column)] =
          picture.white(row, mirrored ? ::astro::film::paper::kCells - 1 - column : column);
}

std::array<Vector3d, 4> Patch::corners_m() const {
  const auto at = [&](double x_m, double y_m) { return Vector3d(origin_m + x_axis * x_m + y_axis * y_m); };
  return {at(x_from_m, y_from_m), at(x_to_m, y_from_m), at(x_to_m, y_to_m), at(x_from_m, y_to_m)};
}

Patch tag_patch(const TagPaper& tag, double x_m, double y_m, double z_m, double yaw_rad, double tilt_x_rad,
                double tilt_y_rad) {
  const Matrix3d turn = (AngleAxisd(yaw_rad, Vector3d::UnitZ()) * AngleAxisd(tilt_y_rad, Vector3d::UnitY()) *
                         AngleAxisd(tilt_x_rad, Vector3d::UnitX()))
                            .toRotationMatrix();
  const double half_m = tag.half_paper_m();
  return {{x_m, y_m, z_m}, turn.col(0), turn.col(1), -half_m, half_m, -half_m, half_m, kPaper, &tag};
}

PatchView::PatchView(const Patch& patch, const Camera& camera)
    : x_from_(static_cast<float>(patch.x_from_m)),
      x_to_(static_cast<float>(patch.x_to_m)),
      y_from_(static_cast<float>(patch.y_from_m)),
      y_to_(static_cast<float>(patch.y_to_m)),
      grey_(patch.grey),
      tag_(patch.tag) {
  const Vector3d normal = patch.x_axis.cross(patch.y_axis);
  if (normal.dot(camera.position_m - patch.origin_m) <= 0) return;  // seen from behind: never hit
  Matrix3d to_camera;                                               // of (x, y, 1) in the patch, up to scale
  to_camera.col(0) = patch.x_axis;
  to_camera.col(1) = patch.y_axis;
  to_camera.col(2) = patch.origin_m - camera.position_m;
  const Matrix3d from_ray = (camera.world_to_camera * to_camera).inverse();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      m_[static_cast<std::size_t>(3 * row + column)] = static_cast<float>(from_ray(row, column));
}

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
