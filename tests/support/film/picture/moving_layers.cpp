#include "tests/support/film/picture/moving_layers.hpp"

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

namespace {

constexpr float kTrousers = 0.08F;

/// A cone in the picture: two circles and what is between them.
struct Outline {
  Pixel foot, hip;
  double foot_px, hip_px;
};

bool is_there(const Leg& leg, const Exposure& exposure) {
  return exposure.first_row_s >= leg.from_s && exposure.first_row_s <= leg.to_s;
}

Outline outline_of(const Leg& leg, const Exposure& exposure) {
  const double part = (exposure.first_row_s - leg.from_s) / (leg.to_s - leg.from_s);
  const double x_m = std::lerp(leg.from.x_m, leg.to.x_m, part);
  const double y_m = std::lerp(leg.from.y_m, leg.to.y_m, part);
  const Eigen::Vector3d foot(x_m, y_m, 0), hip(x_m, y_m, leg.hip_m);
  const auto size_px = [&](const Eigen::Vector3d& at, double radius_m) {
    return exposure.lens->f_px * radius_m / (at - exposure.camera.position_m).norm();
  };
  return {seen_at(*exposure.lens, exposure.camera, foot), seen_at(*exposure.lens, exposure.camera, hip),
          size_px(foot, leg.foot_radius_m), size_px(hip, leg.hip_radius_m)};
}

}  // namespace

Window window_of(const Leg& leg, const Exposure& exposure) {
  if (!is_there(leg, exposure)) return {};
  const Outline outline = outline_of(leg, exposure);
  const auto around = [](Pixel centre, double radius_px) {
    return Window{static_cast<int>(centre.u - radius_px) - 2, static_cast<int>(centre.v - radius_px) - 2,
                  static_cast<int>(centre.u + radius_px) + 3, static_cast<int>(centre.v + radius_px) + 3};
  };
  return around(outline.foot, outline.foot_px)
      .joined(around(outline.hip, outline.hip_px))
      .within({0, 0, exposure.lens->width_px, exposure.lens->height_px});
}

void draw_leg(Plane& light, const Leg& leg, const Exposure& exposure) {
  const Window window = window_of(leg, exposure).within(light.window());
  if (window.empty()) return;
  const Outline outline = outline_of(leg, exposure);
  const double du = outline.hip.u - outline.foot.u, dv = outline.hip.v - outline.foot.v;
  const double length2 = du * du + dv * dv;
  for (int v = window.top; v < window.bottom; ++v) {
    float* const row = light.row(v);
    for (int u = window.left; u < window.right; ++u) {
      const double along =
          std::clamp(((u - outline.foot.u) * du + (v - outline.foot.v) * dv) / length2, 0.0, 1.0);
      const double away_px = std::hypot(u - outline.foot.u - along * du, v - outline.foot.v - along * dv);
      const double inside_px = std::lerp(outline.foot_px, outline.hip_px, along) - away_px;
      const auto covered = static_cast<float>(std::clamp(inside_px + 0.5, 0.0, 1.0));
      row[u] += covered * (kTrousers - row[u]);
    }
  }
}

}  // namespace astro::support::film
