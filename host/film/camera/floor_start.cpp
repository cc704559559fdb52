#include "host/film/camera/floor_start.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/film/camera/planar_pose.hpp"

namespace astro::film {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kBiggest = 3;
// From straight above all focal lengths fit equally well, so this small cost prefers the usual one. From an
// oblique view a wrong focal length costs a hundred times more.
constexpr double kUsual = 0.8, kUnusual = 2e-4;

/// The corners of all tags on the plane of the floor; nothing if one is not in front of the camera.
std::optional<std::vector<TagCorners>> on_floor(const Camera& camera, const std::vector<SeenFloorTag>& tags) {
  std::vector<TagCorners> flat;
  for (const SeenFloorTag& tag : tags) {
    TagCorners& corners = flat.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const auto p = on_plane(camera, tag.corners[i], 0);
      if (!p) return std::nullopt;
      corners[i] = *p;
    }
  }
  return flat;
}

/// The mean square by which the logarithms of sides and diagonals differ from those of one common square.
double unlikeness(const std::vector<TagCorners>& flat) {
  std::vector<double> logs;
  double mean = 0;
  for (const TagCorners& corners : flat) {
    for (std::size_t i = 0; i < 4; ++i) logs.push_back(std::log((corners[(i + 1) % 4] - corners[i]).norm()));
    logs.push_back(std::log((corners[2] - corners[0]).norm()) - 0.5 * std::log(2));
    logs.push_back(std::log((corners[3] - corners[1]).norm()) - 0.5 * std::log(2));
  }
  for (const double value : logs) mean += value / static_cast<double>(logs.size());
  double squares = 0;
  for (const double value : logs)
    squares += (value - mean) * (value - mean) / static_cast<double>(logs.size());
  return squares;
}

FloorTag placed(int id, const TagCorners& flat) {
  const Vector2d middle = center_of(flat);
  double along = 0, across = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d q = unit_corner(i);
    along += q.dot(flat[i]);
    across += q.x() * flat[i].y() - q.y() * flat[i].x();
  }
  return {id, {middle.x(), middle.y(), std::atan2(across, along)}};
}

/// Expresses the scene in the frame of its first tag.
void make_first_origin(Scene& scene) {
  const Pose2 origin = scene.tags.front().pose;
  for (FloorTag& tag : scene.tags) tag.pose = wrapped(origin.between(tag.pose));
  Camera& camera = scene.camera;
  const Pose2 at = origin.between({camera.position_m.x(), camera.position_m.y(), 0});
  camera.position_m.head<2>() << at.x_m, at.y_m;
  camera.rotation *= rotation_by({0, 0, origin.theta_rad});
}

/// The camera in the frame of a square with this pose.
Camera seen_from(const PlanarPose& pose, double f_px, int width_px, int height_px) {
  Camera camera;
  camera.f_px = f_px;
  camera.cx_px = 0.5 * (width_px - 1);
  camera.cy_px = 0.5 * (height_px - 1);
  camera.rotation = pose.rotation;
  camera.position_m = -pose.rotation.transpose() * pose.translation_m;
  return camera;
}

std::vector<std::size_t> biggest(const std::vector<SeenFloorTag>& tags) {
  std::vector<std::size_t> order(tags.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return longest_side(tags[a].corners) > longest_side(tags[b].corners);
  });
  order.resize(std::min(order.size(), kBiggest));
  return order;
}

}  // namespace

std::optional<Scene> floor_start(const std::vector<SeenFloorTag>& tags, int width_px, int height_px,
                                 double floor_side_m) {
  double least = std::numeric_limits<double>::infinity();
  Camera best;
  for (const double ratio : {0.8, 0.55, 0.65, 0.95, 1.15, 1.5}) {  // focal length over width
    const double f_px = ratio * width_px;
    for (const std::size_t index : biggest(tags)) {
      TagCorners rays = tags[index].corners;
      for (Vector2d& ray : rays) ray = (ray - Vector2d(0.5 * (width_px - 1), 0.5 * (height_px - 1))) / f_px;
      const auto poses = planar_poses(rays, floor_side_m);
      if (!poses) continue;
      for (const PlanarPose& pose : *poses) {
        const Camera camera = seen_from(pose, f_px, width_px, height_px);
        if (!(camera.position_m.z() > 0)) continue;
        const auto flat = on_floor(camera, tags);
        if (!flat) continue;
        const double unusual = std::log(ratio / kUsual);
        const double here = unlikeness(*flat) + kUnusual * unusual * unusual;
        if (!(here < least)) continue;
        least = here;
        best = camera;
      }
    }
  }
  if (!std::isfinite(least)) return std::nullopt;
  Scene scene;
  scene.camera = best;
  scene.width_px = width_px;
  scene.height_px = height_px;
  scene.floor_side_m = floor_side_m;
  const auto flat = on_floor(best, tags);
  for (std::size_t i = 0; i < tags.size(); ++i) scene.tags.push_back(placed(tags[i].id, (*flat)[i]));
  make_first_origin(scene);
  return scene;
}

}  // namespace astro::film
