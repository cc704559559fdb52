#pragma once

#include "tests/support/film/picture/plane.hpp"
#include "tests/support/film/picture/scene.hpp"

namespace astro::support::film {

/// Where in the picture a robot is at some time during the exposure.
Window window_of(const FilmedRobot& robot, const Exposure& exposure);

/// Draws a robot over what is there: each row at its own time, averaged over its exposure. Without blur of the lens.
void draw_robot(Plane& light, const FilmedRobot& robot, const Exposure& exposure);

/// Where in the picture a leg is during the exposure; empty if it is not there.
Window window_of(const Leg& leg, const Exposure& exposure);

/// Draws a leg over what is there.
void draw_leg(Plane& light, const Leg& leg, const Exposure& exposure);

}  // namespace astro::support::film
