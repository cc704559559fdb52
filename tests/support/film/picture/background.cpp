#include "tests/support/film/picture/background.hpp"

#include <cmath>

#include "tests/support/film/picture/samples.hpp"

namespace astro::support::film {
namespace {

constexpr int kTagSamples = 48;
constexpr float kFloorEnd_m = 8, kWall = 0.45F;

/// The floor's light where each pixel's centre looks.
Plane bare_floor(const Scene& scene, const FloorTexture& texture, const RayTable& rays, const Lens& lens,
                 const Camera& camera) {
  Plane light(Window{0, 0, lens.width_px, lens.height_px});
  const Eigen::Matrix3f to_world = camera.world_to_camera.transpose().cast<float>();
  const Eigen::Vector3f place = camera.position_m.cast<float>();
  for (int v = 0; v < lens.height_px; ++v) {
    float* const row = light.row(v);
    for (int u = 0; u < lens.width_px; ++u) {
      const Eigen::Vector3f way = to_world * Eigen::Vector3f(rays.x(u, v), rays.y(u, v), 1);
      const float length = way.z() < 0 ? -place.z() / way.z() : kFloorEnd_m + 1;
      const float x = place.x() + length * way.x(), y = place.y() + length * way.y();
      row[u] = std::hypot(x - place.x(), y - place.y()) > kFloorEnd_m
                   ? kWall
                   : scene.floor_grey * (1 + scene.floor_contrast * texture.at(x, y));
    }
  }
  return light;
}

void lay(Plane& light, const Patch& patch, const RayTable& rays, const Lens& lens, const Camera& camera) {
  const PatchView view(patch, camera);
  const Window window = window_of({patch}, lens, camera);
  for (int v = window.top; v < window.bottom; ++v) {
    float* const row = light.row(v);
    for (int u = window.left; u < window.right; ++u) {
      const RayTable::Local ray = rays.at(u, v);
      PixelSamples samples(u, v, 1);
      float sum = 0;
      for (int i = 0; i < kTagSamples; ++i) {
        const PixelSample at = samples.next();
        float reflectance = row[u];
        view.hit(ray.x + ray.dx_du * at.u + ray.dx_dv * at.v, ray.y + ray.dy_du * at.u + ray.dy_dv * at.v,
                 reflectance);
        sum += reflectance;
      }
      row[u] = sum / kTagSamples;
    }
  }
}

}  // namespace

Window window_of(const std::vector<Patch>& patches, const Lens& lens, const Camera& camera) {
  Window window{lens.width_px, lens.height_px, 0, 0};
  for (const Patch& patch : patches) {
    for (const Eigen::Vector3d& corner : patch.corners_m()) {
      const Pixel at = seen_at(lens, camera, corner);
      window = window.joined({static_cast<int>(std::floor(at.u)), static_cast<int>(std::floor(at.v)),
                              static_cast<int>(std::ceil(at.u)) + 1, static_cast<int>(std::ceil(at.v)) + 1});
    }
  }
  return window.grown(2).within({0, 0, lens.width_px, lens.height_px});
}

Plane sharp_background(const Scene& scene, const FloorTexture& texture, const RayTable& rays,
                       const Lens& lens, const Camera& camera) {
  Plane light = bare_floor(scene, texture, rays, lens, camera);
  for (const FloorTag& tag : scene.floor) lay(light, tag.patch(), rays, lens, camera);
  return light;
}

}  // namespace astro::support::film
