#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace astro::support {

struct PicturePoint {
  double x_px = 0, y_px = 0;  // right, down; 0 is the centre of the first pixel
};

struct ReadTag {
  int id = 0, wrong_bits = 0;
  /// Of the black square of the upright tag: upper left, upper right, lower right, lower left.
  std::array<PicturePoint, 4> corners;
};

/// The tags that libapriltag finds in a picture of 8-bit grey, rows one after the other. `decimate`: 1 looks at every pixel.
std::vector<ReadTag> read_tags(std::span<const std::uint8_t> grey, int width_px, int height_px,
                               float decimate = 1);

}  // namespace astro::support
