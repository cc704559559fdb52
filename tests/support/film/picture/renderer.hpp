#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tests/support/film/picture/floor_texture.hpp"
#include "tests/support/film/picture/moving_layers.hpp"
#include "tests/support/film/picture/sensor.hpp"

namespace astro::support::film {

/// Pictures of a scene. The floor is drawn again only when the camera has moved; what moves on it is drawn for each picture, in
/// windows of its own.
///
/// Cost    1080p, one core: about 6 ms a picture with one robot; 0.1 s more if the camera has moved
class Renderer {
 public:
  /// `blur_px`: standard deviation of the lens's point spread.
  Renderer(Scene scene, const Lens& lens, double blur_px, const SensorModel& sensor, std::uint64_t seed);

  const Lens& lens() const { return lens_; }
  const Scene& scene() const { return scene_; }

  /// Writes brightness, row after row, of a picture whose first row was exposed at `first_row_s` by the robot's clock.
  void render(const Camera& camera, const Shutter& shutter, double first_row_s, std::uint8_t* picture);

 private:
  void look_from(const Camera& camera);
  void draw_window(const Window& window, const Exposure& exposure, std::uint8_t* picture);

  Scene scene_;
  Lens lens_;
  double blur_px_;
  RayTable rays_;
  FloorTexture texture_;
  Sensor sensor_;
  std::optional<Camera> seen_from_;
  Plane sharp_floor_;
  Developed floor_;
};

}  // namespace astro::support::film
