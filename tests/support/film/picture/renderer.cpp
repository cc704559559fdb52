#include "tests/support/film/picture/renderer.hpp"

#include "tests/support/film/picture/background.hpp"
#include "tests/support/film/picture/blur.hpp"

namespace astro::support::film {
namespace {

constexpr double kStill_px = 0.02;  // a camera that has moved by less sees the same floor

double moved_px(const Lens& lens, const Camera& before, const Camera& now) {
  double most_px = 0;
  for (const double x_m : {-1.5, 0.0, 1.5}) {
    for (const double y_m : {0.0, 1.0, 2.0}) {
      const Eigen::Vector3d place(x_m, y_m, 0);
      const Pixel a = seen_at(lens, before, place), b = seen_at(lens, now, place);
      most_px = std::max(most_px, std::hypot(a.u - b.u, a.v - b.v));
    }
  }
  return most_px;
}

/// Windows that meet become one, so that no pixel is drawn twice.
std::vector<Window> apart(std::vector<Window> windows) {
  std::erase_if(windows, [](const Window& window) { return window.empty(); });
  for (std::size_t i = 0; i < windows.size(); ++i) {
    for (std::size_t j = i + 1; j < windows.size(); ++j) {
      if (!windows[i].meets(windows[j])) continue;
      windows[i] = windows[i].joined(windows[j]);
      windows.erase(windows.begin() + static_cast<std::ptrdiff_t>(j));
      return apart(std::move(windows));
    }
  }
  return windows;
}

}  // namespace

Renderer::Renderer(Scene scene, const Lens& lens, double blur_px, const SensorModel& sensor,
                   std::uint64_t seed)
    : scene_(std::move(scene)),
      lens_(lens),
      blur_px_(blur_px),
      rays_(lens),
      texture_(seed),
      sensor_(sensor, lens.width_px, lens.height_px, seed) {}

void Renderer::render(const Camera& camera, const Shutter& shutter, double first_row_s,
                      std::uint8_t* picture) {
  if (!seen_from_ || moved_px(lens_, *seen_from_, camera) > kStill_px) look_from(camera);
  const Exposure exposure{&lens_, &rays_, *seen_from_, shutter, first_row_s};
  sensor_.expose(floor_, picture);
  std::vector<Window> windows;
  const Window whole{0, 0, lens_.width_px, lens_.height_px};
  const int reach = blur_reach_px(blur_px_);
  for (const FilmedRobot& robot : scene_.robots)
    windows.push_back(window_of(robot, exposure).grown(reach).within(whole));
  for (const Leg& leg : scene_.legs)
    if (const Window window = window_of(leg, exposure); !window.empty())
      windows.push_back(window.grown(reach).within(whole));
  for (const Window& window : apart(std::move(windows))) draw_window(window, exposure, picture);
}

void Renderer::look_from(const Camera& camera) {
  seen_from_ = camera;
  sharp_floor_ = sharp_background(scene_, texture_, rays_, lens_, camera);
  floor_ = sensor_.develop(blurred(sharp_floor_, sharp_floor_.window(), blur_px_));
}

void Renderer::draw_window(const Window& window, const Exposure& exposure, std::uint8_t* picture) {
  const Window reached = window.grown(blur_reach_px(blur_px_)).within(sharp_floor_.window());
  Plane light(reached);
  for (int v = reached.top; v < reached.bottom; ++v)
    std::copy(sharp_floor_.row(v) + reached.left, sharp_floor_.row(v) + reached.right,
              light.row(v) + reached.left);
  for (const FilmedRobot& robot : scene_.robots) draw_robot(light, robot, exposure);
  for (const Leg& leg : scene_.legs) draw_leg(light, leg, exposure);
  sensor_.expose(sensor_.develop(blurred(light, window, blur_px_)), picture);
}

}  // namespace astro::support::film
