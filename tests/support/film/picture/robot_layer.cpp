#include "tests/support/film/picture/robot_layer.hpp"

#include <cmath>

#include "tests/support/film/picture/background.hpp"
#include "tests/support/film/picture/samples.hpp"

namespace astro::support::film {
namespace {

constexpr int kMoments = 8;  // of an exposure
constexpr int kTagSamples = 24, kBodySamples = 8;

/// All that the rows of a window see of a robot: the patches at each row's moments.
class RobotViews {
 public:
  RobotViews(const FilmedRobot& robot, const Exposure& exposure, const Window& window) : top_(window.top) {
    for (int v = window.top; v < window.bottom; ++v) {
      const double row_s = exposure.shutter.row_s(exposure.first_row_s, v, exposure.lens->height_px);
      for (int moment = 0; moment < kMoments; ++moment) {
        const double part = (moment + 0.5) / kMoments - 0.5;
        const std::vector<Patch> patches = robot.patches_at(row_s + part * exposure.shutter.exposure_s);
        patches_ = patches.size();
        for (const Patch& patch : patches) views_.emplace_back(patch, exposure.camera);
      }
    }
  }

  void look(int v, int moment, float x, float y, float& reflectance) const {
    const auto first =
        (static_cast<std::size_t>(v - top_) * kMoments + static_cast<std::size_t>(moment)) * patches_;
    for (std::size_t patch = 0; patch < patches_; ++patch)
      if (views_[first + patch].hit(x, y, reflectance)) return;
  }

 private:
  int top_;
  std::size_t patches_ = 0;
  std::vector<PatchView> views_;
};

template <class PatchesAt>
Window window_during(const Exposure& exposure, PatchesAt patches_at) {
  const double readout_s = exposure.shutter.readout_s, half_s = exposure.shutter.exposure_s / 2;
  const double from_s = exposure.first_row_s + std::min(0.0, readout_s) - half_s;
  const double to_s = exposure.first_row_s + std::max(0.0, readout_s) + half_s;
  Window window{exposure.lens->width_px, exposure.lens->height_px, 0, 0};
  constexpr int kSteps = 4;
  for (int step = 0; step <= kSteps; ++step)
    window = window.joined(
        window_of(patches_at(from_s + (to_s - from_s) * step / kSteps), *exposure.lens, exposure.camera));
  return window;
}

}  // namespace

Window window_of(const FilmedRobot& robot, const Exposure& exposure) {
  return window_during(exposure, [&](double time_s) { return robot.patches_at(time_s); });
}

void draw_robot(Plane& light, const FilmedRobot& robot, const Exposure& exposure) {
  const Window window = window_of(robot, exposure).within(light.window());
  if (window.empty()) return;
  const Window tag =
      window_during(exposure, [&](double time_s) { return std::vector{robot.tag_patch_at(time_s)}; });
  const RobotViews views(robot, exposure, window);
  for (int v = window.top; v < window.bottom; ++v) {
    float* const row = light.row(v);
    for (int u = window.left; u < window.right; ++u) {
      const bool in_tag = v >= tag.top && v < tag.bottom && u >= tag.left && u < tag.right;
      const int count = in_tag ? kTagSamples : kBodySamples;
      const RayTable::Local ray = exposure.rays->at(u, v);
      PixelSamples samples(u, v, kMoments);
      float sum = 0;
      for (int i = 0; i < count; ++i) {
        const PixelSample at = samples.next();
        float reflectance = row[u];
        views.look(v, at.moment, ray.x + ray.dx_du * at.u + ray.dx_dv * at.v,
                   ray.y + ray.dy_du * at.u + ray.dy_dv * at.v, reflectance);
        sum += reflectance;
      }
      row[u] = sum / static_cast<float>(count);
    }
  }
}

}  // namespace astro::support::film
