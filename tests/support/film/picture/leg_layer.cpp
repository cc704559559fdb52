#include "tests/support/film/picture/leg_layer.hpp"

#include <cmath>
#include <numeric>

namespace astro::support::film {
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
