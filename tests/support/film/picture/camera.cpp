#include "tests/support/film/picture/camera.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace astro::support::film {

namespace {

/// Newton's iteration from a start; the derivative leaves out the tangential terms, which are small.
Ray refined(const Lens& lens, Pixel wanted, Ray ray) {
  for (int round = 0; round < 50; ++round) {
    const Pixel seen = seen_at(lens, ray);
    const double du = (wanted.u - seen.u) / lens.f_px, dv = (wanted.v - seen.v) / lens.f_px;
    const double r2 = ray.x * ray.x + ray.y * ray.y;
    const double s = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
    const double ds = 2 * (lens.k1 + r2 * (2 * lens.k2 + r2 * 3 * lens.k3));
    const double xx = s + ds * ray.x * ray.x, yy = s + ds * ray.y * ray.y, xy = ds * ray.x * ray.y;
    const double determinant = xx * yy - xy * xy;
    const double x = (yy * du - xy * dv) / determinant, y = (xx * dv - xy * du) / determinant;
    ray = {ray.x + x, ray.y + y};
    if (std::abs(x) + std::abs(y) < 1e-11) break;
  }
  return ray;
}

Ray first_guess(const Lens& lens, Pixel pixel) {
  return {(pixel.u - lens.cx_px) / lens.f_px, (pixel.v - lens.cy_px) / lens.f_px};
}

}  // namespace

Pixel seen_at(const Lens& lens, Ray ray) {
  const double x = ray.x, y = ray.y, r2 = x * x + y * y;
  const double s = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  return {lens.cx_px + lens.f_px * (s * x + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x)),
          lens.cy_px + lens.f_px * (s * y + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y)};
}

Ray ray_of(const Lens& lens, Pixel pixel) { return refined(lens, pixel, first_guess(lens, pixel)); }

RayTable::RayTable(const Lens& lens) : width_(lens.width_px), height_(lens.height_px) {
  x_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  y_.resize(x_.size());
  for (int v = 0; v < height_; ++v) {
    Ray ray = first_guess(lens, {0, static_cast<double>(v)});
    for (int u = 0; u < width_; ++u) {
      ray = refined(lens, {static_cast<double>(u), static_cast<double>(v)}, ray);  // beside its neighbour
      x_[index(u, v)] = static_cast<float>(ray.x);
      y_[index(u, v)] = static_cast<float>(ray.y);
    }
  }
}

RayTable::Local RayTable::at(int u, int v) const {
  const int left = std::max(u - 1, 0), right = std::min(u + 1, width_ - 1);
  const int up = std::max(v - 1, 0), down = std::min(v + 1, height_ - 1);
  const float du = static_cast<float>(right - left), dv = static_cast<float>(down - up);
  return {x(u, v),
          y(u, v),
          (x(right, v) - x(left, v)) / du,
          (x(u, down) - x(u, up)) / dv,
          (y(right, v) - y(left, v)) / du,
          (y(u, down) - y(u, up)) / dv};
}

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
