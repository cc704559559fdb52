#pragma once

#include "tests/support/film/picture/floor_texture.hpp"
#include "tests/support/film/picture/plane.hpp"
#include "tests/support/film/picture/scene.hpp"

namespace astro::support::film {

/// The floor with its tags as a standing camera sees it, without blur of the lens. Beyond the floor's end, 8 m away, is a wall.
Plane sharp_background(const Scene& scene, const FloorTexture& texture, const RayTable& rays,
                       const Lens& lens, const Camera& camera);

/// Where corners are seen in the picture, grown by two pixels and cut to it.
Window window_of(const std::vector<Patch>& patches, const Lens& lens, const Camera& camera);

}  // namespace astro::support::film
