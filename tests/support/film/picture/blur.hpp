#pragma once

#include "tests/support/film/picture/plane.hpp"

namespace astro::support::film {

/// How far a blur of this standard deviation reaches.
int blur_reach_px(double sigma_px);

/// The window's light as a lens with a Gaussian point spread shows it. `sharp` covers the window grown by the reach, except where
/// the picture ends: there its outer pixels go on.
Plane blurred(const Plane& sharp, const Window& window, double sigma_px);

}  // namespace astro::support::film
