#include "host/film/camera/scene.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace astro::film {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

/// A point on a tag, in the frame of the floor.
Vector2d place_of(const Vector2d& point, const Pose2& tag) {
  const Point2 at = tag * Point2{point.x(), point.y()};
  return {at.x_m, at.y_m};
}

double mean_row(const TagCorners& corners) {
  return (corners[0].y() + corners[1].y() + corners[2].y() + corners[3].y()) / 4;
}

/// Changes the focal length together with what the film cannot distinguish from it: as it grows, the camera
/// moves back and leans more in proportion, and the lens distorts the same pixels by as much. What a floor
/// seen from straight above does not show is then one parameter, and not a curved valley of the cost through
/// six.
void change_focal_length(Camera& camera, double by_px) {
  constexpr double kLevel = -0.1;  // an optical axis that hardly points down meets the floor too far away
  const double part = by_px / camera.f_px;
  const Vector3d axis = camera.rotation.row(2).transpose();
  if (axis.z() < kLevel) {
    const double distance_m = -camera.position_m.z() / axis.z();
    const Vector3d target = camera.position_m + distance_m * axis;
    camera.rotation *= rotation_by(part * axis.z() * Vector3d(axis.y(), -axis.x(), 0));
    camera.position_m = target - (1 + part) * distance_m * camera.rotation.row(2).transpose();
  }
  camera.f_px += by_px;
  camera.k1 *= (1 + part) * (1 + part);
  camera.k2 *= std::pow(1 + part, 4);
}

// The order of the parameters. Each floor tag except the first adds three.
enum : std::size_t {
  kF,
  kCx,
  kCy,
  kK1,
  kK2,
  kTurn,
  kPosition = 8,
  kFloorSide = 11,
  kFloorShift,
  kRobotSide,
  kRobotShift,
  kHeight,
  kTilt,
  kTags = 18
};

}  // namespace

std::optional<double> distance_between(const Scene& scene, int from, int to) {
  const auto tag = [&](int id) -> const Pose2* {
    for (const FloorTag& one : scene.tags)
      if (one.id == id) return &one.pose;
    return nullptr;
  };
  const Pose2 *a = tag(from), *b = tag(to);
  if (a == nullptr || b == nullptr) return std::nullopt;
  return std::hypot(b->x_m - a->x_m, b->y_m - a->y_m);
}

TagCorners with_edges_shifted(const TagCorners& corners, double shift_px) {
  TagCorners shifted = corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d before = (corners[i] - corners[(i + 3) % 4]).normalized();
    const Eigen::Vector2d after = (corners[(i + 1) % 4] - corners[i]).normalized();
    // The shift n has a component of 1 along the inward normals (y, -x) of both edges.
    const double across = before.x() * after.y() - before.y() * after.x();
    if (across == 0) continue;
    shifted[i] += (after - before) * (shift_px / -across);
  }
  return shifted;
}

TagCorners floor_corners(const Scene& scene, std::size_t index) {
  const Pose2& tag = scene.tags[index].pose;
  TagCorners corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d p = place_of(scene.floor_side_m * unit_corner(i), tag);
    corners[i] = project(scene.camera, {p.x(), p.y(), 0});
  }
  return with_edges_shifted(corners, scene.floor_shift_px);
}

double row_delay_s(const Scene& scene, const TagCorners& seen) {
  return mean_row(seen) / scene.height_px * scene.readout_s;
}

TagCorners robot_corners(const Scene& scene, const Pose2& pose, const RobotVelocity& velocity,
                         const TagCorners& seen) {
  const double mean = mean_row(seen);
  TagCorners corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const double dt_s = (seen[i].y() - mean) / scene.height_px * scene.readout_s;
    const Vector2d q = scene.robot_side_m * unit_corner(i);
    const Vector2d p = place_of(q, {pose.x_m + velocity.x_mps * dt_s, pose.y_m + velocity.y_mps * dt_s,
                                    pose.theta_rad + velocity.omega_radps * dt_s});
    corners[i] = project(scene.camera, {p.x(), p.y(), scene.robot_height_m + scene.robot_tilt.dot(q)});
  }
  return with_edges_shifted(corners, scene.robot_shift_px);
}

std::optional<Pose2> rough_pose(const Scene& scene, const TagCorners& seen) {
  Vector2d mean(0, 0);
  double along = 0, across = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto p = on_plane(scene.camera, seen[i], scene.robot_height_m);
    if (!p) return std::nullopt;
    const Vector2d q = unit_corner(i);
    mean += *p / 4;
    along += q.dot(*p);
    across += q.x() * p->y() - q.y() * p->x();
  }
  return Pose2{mean.x(), mean.y(), std::atan2(across, along)};
}

std::vector<SceneParameter> parameters_of(const Scene& scene, const Figures& figures) {
  // Main cameras of phones have 0.6 to 0.95. A film from straight above hardly shows the focal length.
  constexpr double kUsual = 0.8, kUsualWithin = 0.2;  // of the width of the picture
  Measured f = figures.focal_length_px;
  if (f.sigma == 0) f = {kUsual * scene.width_px, kUsualWithin * scene.width_px};
  std::vector<SceneParameter> all{{"focal length, px", 1e-2, f.value, f.sigma},
                                  {"centre x, px", 1e-2, 0.5 * (scene.width_px - 1), 25},
                                  {"centre y, px", 1e-2, 0.5 * (scene.height_px - 1), 25},
                                  {"k1", 1e-5, 0, 0.2},
                                  {"k2", 1e-5, 0, 0.4}};
  for (const char* axis : {"x", "y", "z"}) all.push_back({fmt::format("camera turn {}, rad", axis), 1e-6});
  for (const char* axis : {"x", "y", "z"}) all.push_back({fmt::format("camera {}, m", axis), 1e-6});
  all.push_back(
      {"side of floor tags, m", 1e-6, figures.floor_side_m.value, figures.floor_side_m.sigma, true, false});
  all.push_back({"edges of floor tags, px", 1e-3, 0, 0.5, true, false});
  all.push_back(
      {"side of the robot's tag, m", 1e-6, figures.robot_side_m.value, figures.robot_side_m.sigma, false});
  all.push_back({"edges of the robot's tag, px", 1e-3, 0, 0.5, false});
  all.push_back({"height of the robot's tag, m", 1e-6, figures.robot_height_m.value,
                 figures.robot_height_m.sigma, false});
  constexpr double kTilt_rad = 0.0105;  // 0.6 degrees
  for (const char* axis : {"x", "y"})
    all.push_back({fmt::format("tilt along {}, rad", axis), 1e-6, 0, kTilt_rad, false});
  for (std::size_t i = 1; i < scene.tags.size(); ++i)
    for (const char* part : {"x, m", "y, m", "yaw, rad"})
      all.push_back(
          {fmt::format("tag {} {}", scene.tags[i].id, part), 1e-6, 0, 0, true, false, static_cast<int>(i)});
  return all;
}

double parameter_value(const Scene& scene, std::size_t index) {
  switch (index) {
    case kF:
      return scene.camera.f_px;
    case kCx:
      return scene.camera.cx_px;
    case kCy:
      return scene.camera.cy_px;
    case kK1:
      return scene.camera.k1;
    case kK2:
      return scene.camera.k2;
    case kFloorSide:
      return scene.floor_side_m;
    case kFloorShift:
      return scene.floor_shift_px;
    case kRobotSide:
      return scene.robot_side_m;
    case kRobotShift:
      return scene.robot_shift_px;
    case kHeight:
      return scene.robot_height_m;
    case kTilt:
    case kTilt + 1:
      return scene.robot_tilt[static_cast<Eigen::Index>(index - kTilt)];
    default:
      return 0;
  }
}

Scene moved(const Scene& scene, const Eigen::VectorXd& change) {
  const auto at = [&](std::size_t index) { return change[static_cast<Eigen::Index>(index)]; };
  Scene to = scene;
  change_focal_length(to.camera, at(kF));
  to.camera.cx_px += at(kCx);
  to.camera.cy_px += at(kCy);
  to.camera.k1 += at(kK1);
  to.camera.k2 += at(kK2);
  to.camera.rotation = rotation_by({at(kTurn), at(kTurn + 1), at(kTurn + 2)}) * to.camera.rotation;
  to.camera.position_m += Vector3d(at(kPosition), at(kPosition + 1), at(kPosition + 2));
  to.floor_side_m += at(kFloorSide);
  to.floor_shift_px += at(kFloorShift);
  to.robot_side_m += at(kRobotSide);
  to.robot_shift_px += at(kRobotShift);
  to.robot_height_m += at(kHeight);
  to.robot_tilt += Vector2d(at(kTilt), at(kTilt + 1));
  for (std::size_t i = 1; i < to.tags.size(); ++i) {
    const std::size_t first = kTags + 3 * (i - 1);
    to.tags[i].pose.x_m += at(first);
    to.tags[i].pose.y_m += at(first + 1);
    to.tags[i].pose.theta_rad += at(first + 2);
  }
  return to;
}

Measured measured_by(const Scene& scene, const std::vector<SceneParameter>& parameters,
                     const Eigen::MatrixXd& covariance, const SceneValue& value) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
  Eigen::VectorXd change = gradient;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    change[at] = parameters[i].step;
    gradient[at] = (value(moved(scene, change)) - value(moved(scene, -change))) / (2 * parameters[i].step);
    change[at] = 0;
  }
  return {value(scene), std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)))};
}

}  // namespace astro::film
