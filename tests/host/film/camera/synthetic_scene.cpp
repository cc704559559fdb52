#include "tests/host/film/camera/synthetic_scene.hpp"

#include <cmath>
#include <numbers>

namespace astro::support {
namespace {

/// Above the floor point (0, y), looking down by `down_rad` in the direction of y.
film::Camera looking_down(double height_m, double y_m, double down_rad) {
  film::Camera camera;
  camera.f_px = 1510;
  camera.cx_px = 968;
  camera.cy_px = 533;
  camera.k1 = 0.07;
  camera.k2 = -0.12;
  camera.position_m = {0, y_m, height_m};
  const double s = std::sin(down_rad), c = std::cos(down_rad);
  camera.rotation << 1, 0, 0, 0, -s, -c, 0, c, -s;
  return camera;
}

film::Scene scene_with(const film::Camera& camera) {
  film::Scene scene;
  scene.camera = camera;
  scene.width_px = 1920;
  scene.height_px = 1080;
  scene.floor_shift_px = 0.12;
  scene.robot_shift_px = 0.08;
  scene.robot_height_m = 0.12;
  scene.robot_tilt = {0.004, -0.003};
  scene.readout_s = 0.02;
  scene.tags = {{1, {-1.2, -0.2, 0.3}}, {2, {1.2, -0.2, 1.1}}, {3, {-1.5, 1.4, -2}},
                {4, {1.5, 1.4, 0}},     {5, {0.1, 1.6, 0.7}},  {6, {0, -0.4, -1}}};
  // The first is the frame.
  const Pose2 origin = scene.tags.front().pose;
  const Eigen::Matrix3d back = film::rotation_by({0, 0, -origin.theta_rad});
  const Eigen::Vector3d at(origin.x_m, origin.y_m, 0);
  for (film::FloorTag& tag : scene.tags) {
    const Eigen::Vector3d p = back * (Eigen::Vector3d(tag.pose.x_m, tag.pose.y_m, 0) - at);
    tag.pose = {p.x(), p.y(), std::remainder(tag.pose.theta_rad - origin.theta_rad, 2 * std::numbers::pi)};
  }
  scene.camera.position_m = back * (camera.position_m - at);
  scene.camera.rotation = camera.rotation * back.transpose();
  return scene;
}

}  // namespace

film::Scene phone_scene() { return scene_with(looking_down(2, -1.75, 0.7)); }

film::Scene ceiling_scene() { return scene_with(looking_down(2.6, 0.6, 0.5 * std::numbers::pi)); }

std::vector<film::TagCorners> seen_floor(const film::Scene& scene) {
  std::vector<film::TagCorners> all;
  for (std::size_t i = 0; i < scene.tags.size(); ++i) all.push_back(film::floor_corners(scene, i));
  return all;
}

std::vector<film::RobotSighting> seen_robot(const film::Scene& scene, std::size_t count) {
  std::vector<film::RobotSighting> all;
  const Pose2 &a = scene.tags[0].pose, &b = scene.tags[3].pose;
  const double length = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m),
               angle = std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
  for (std::size_t i = 0; i < count; ++i) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const double along = length * (0.5 + 0.3 * std::cos(phase)), across = 0.5 * std::sin(2 * phase);
    const double heading = 7 * phase;
    film::RobotSighting one;
    one.pose = {std::cos(angle) * along - std::sin(angle) * across,
                std::sin(angle) * along + std::cos(angle) * across, heading};
    one.velocity = {0.4 * std::cos(heading), 0.4 * std::sin(heading), 1.2 * std::sin(3 * phase)};
    // Which row a corner is read in depends on where it is then.
    one.corners = film::robot_corners(scene, one.pose, {}, {});
    for (int k = 0; k < 5; ++k) one.corners = film::robot_corners(scene, one.pose, one.velocity, one.corners);
    all.push_back(one);
  }
  return all;
}

void add_noise(film::TagCorners& corners, double sigma_px, std::mt19937& random) {
  std::normal_distribution<double> noise(0, sigma_px);
  for (Eigen::Vector2d& corner : corners) corner += Eigen::Vector2d(noise(random), noise(random));
}

}  // namespace astro::support
