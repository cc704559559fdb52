#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "host/truth/film/video/gray_frame.hpp"

namespace astro::film {

struct Colour {
  std::uint8_t red, green, blue;
};

/// A colour picture to draw on. What lies outside is cut off.
class Canvas {
 public:
  explicit Canvas(const GrayFrame& frame);

  /// Two pixels wide.
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour);
  /// Digits, 15 by 21 px each, from the top left corner `at` on.
  void number(const Eigen::Vector2d& at, int value, Colour colour);

  /// As a PNG file.
  std::vector<std::uint8_t> png() const;

 private:
  void dot(int x, int y, Colour colour);

  int width_, height_;
  std::vector<std::uint8_t> pixels_;  // red, green, blue
};

}  // namespace astro::film
