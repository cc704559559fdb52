#include "host/film/camera/camera.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace astro::film {

using Eigen::Vector2d, Eigen::Vector3d;

Vector2d project(const Camera& camera, const Vector3d& point_m) {
  const Vector3d p = camera.rotation * (point_m - camera.position_m);
  const double x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
  const double f = camera.f_px * (1 + r2 * (camera.k1 + r2 * camera.k2));
  return {f * x + camera.cx_px, f * y + camera.cy_px};
}

std::optional<Vector2d> on_plane(const Camera& camera, const Vector2d& pixel, double z_m) {
  const Vector2d distorted((pixel.x() - camera.cx_px) / camera.f_px,
                           (pixel.y() - camera.cy_px) / camera.f_px);
  const double far = distorted.norm();
  double r = far;  // Newton's method for r (1 + k1 r^2 + k2 r^4) = far
  for (int i = 0; i < 20; ++i) {
    const double r2 = r * r;
    const double slope = 1 + r2 * (3 * camera.k1 + 5 * r2 * camera.k2);
    if (!(slope > 0.05)) return std::nullopt;
    const double step = (r * (1 + r2 * (camera.k1 + r2 * camera.k2)) - far) / slope;
    r -= step;
    if (std::abs(step) < 1e-14) break;
  }
  const Vector2d ideal = far > 0 ? Vector2d(distorted * (r / far)) : distorted;
  const Vector3d ray = camera.rotation.transpose() * Vector3d(ideal.x(), ideal.y(), 1);
  const double along = (z_m - camera.position_m.z()) / ray.z();
  if (!(along > 0) || !std::isfinite(along)) return std::nullopt;
  return Vector2d((camera.position_m + along * ray).head<2>());
}

Eigen::Matrix3d rotation_by(const Vector3d& turn_rad) {
  const double angle = turn_rad.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn_rad / angle).toRotationMatrix();
}

}  // namespace astro::film
