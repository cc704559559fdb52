#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace astro::film {

/// A picture of a film: the luma of each pixel, 0 to 255, row by row from the top, as the camera wrote it (not linear).
/// Pixel centres are integers: the centre of the top left pixel is (0, 0).
struct GrayFrame {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
  double pts_s = 0;  // the presentation time of the film, which need not begin at 0
  bool key = false;  // the codec needs no other picture for it

  const std::uint8_t* row(int y) const {
    return pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
  std::uint8_t at(int x, int y) const { return row(y)[x]; }
};

}  // namespace astro::film
