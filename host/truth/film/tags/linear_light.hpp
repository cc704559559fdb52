#pragma once

#include <array>
#include <cstdint>

namespace astro::film {

/// The light that a pixel value of the sRGB tone curve stands for, 0 to 1. Edges of black on white are symmetric in linear
/// light only: as the camera writes them they seem to lie 0.3 to 0.45 px inside the black.
/// Source  IEC 61966-2-1.
const std::array<float, 256>& linear_light();

}  // namespace astro::film
