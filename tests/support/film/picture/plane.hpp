#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace astro::support::film {

/// Pixels from `left`, `top` up to but without `right`, `bottom`.
struct Window {
  int left = 0, top = 0, right = 0, bottom = 0;

  bool empty() const { return left >= right || top >= bottom; }
  int width() const { return right - left; }
  int height() const { return bottom - top; }
  bool meets(const Window& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  Window joined(const Window& other) const {
    return {std::min(left, other.left), std::min(top, other.top), std::max(right, other.right),
            std::max(bottom, other.bottom)};
  }
  Window grown(int by_px) const { return {left - by_px, top - by_px, right + by_px, bottom + by_px}; }
  Window within(const Window& other) const {
    return {std::max(left, other.left), std::max(top, other.top), std::min(right, other.right),
            std::min(bottom, other.bottom)};
  }
};

/// Light of each pixel of a window; 1 is what makes the sensor's white.
class Plane {
 public:
  Plane() = default;
  explicit Plane(const Window& window)
      : window_(window),
        light_(static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height())) {}

  const Window& window() const { return window_; }
  float* row(int v) { return &light_[offset(v)] - window_.left; }
  const float* row(int v) const { return &light_[offset(v)] - window_.left; }

 private:
  std::size_t offset(int v) const {
    return static_cast<std::size_t>(v - window_.top) * static_cast<std::size_t>(window_.width());
  }
  Window window_;
  std::vector<float> light_;
};

}  // namespace astro::support::film
