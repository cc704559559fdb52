#pragma once

#include "tests/support/film/picture/plane.hpp"
#include "tests/support/film/picture/scene.hpp"
#include "tests/support/film/picture/shutter.hpp"

namespace astro::support::film {

/// One exposure: camera, lens and shutter, and when its first row was exposed, by the robot's clock.
struct Exposure {
  const Lens* lens;
  const RayTable* rays;
  Camera camera;
  Shutter shutter;
  double first_row_s;
};

/// Where in the picture a robot is at some time during the exposure.
Window window_of(const FilmedRobot& robot, const Exposure& exposure);

/// Draws a robot over what is there: each row at its own time, averaged over its exposure. Without blur of the lens.
void draw_robot(Plane& light, const FilmedRobot& robot, const Exposure& exposure);

}  // namespace astro::support::film
