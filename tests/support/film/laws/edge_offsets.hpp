#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace astro::support::film {

struct GreyPicture {
  int width_px, height_px;
  std::vector<std::uint8_t> grey;

  /// Between pixels: bilinear.
  double at(double u, double v) const;
};

struct PicturePlace {
  double u, v;
};

/// Where a black square's edges are, against where they should be: the mean distance of the four edges of a square in pixels,
/// positive if the black is larger. `expected(edge, part)` is the place of an edge's point, part from 0 to 1; edges go round
/// clockwise in the picture. An edge's place is the centroid of the brightness's slope across it, which is without bias for a
/// symmetric blur in linear light.
std::array<double, 4> edge_offsets_px(const GreyPicture& picture,
                                      const std::function<PicturePlace(int edge, double part)>& expected,
                                      double reach_px);

}  // namespace astro::support::film
