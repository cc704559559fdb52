#pragma once

#include "tests/support/film/picture/robot_layer.hpp"

namespace astro::support::film {

/// Where in the picture a leg is during the exposure; empty if it is not there.
Window window_of(const Leg& leg, const Exposure& exposure);

/// Draws a leg over what is there.
void draw_leg(Plane& light, const Leg& leg, const Exposure& exposure);

}  // namespace astro::support::film
