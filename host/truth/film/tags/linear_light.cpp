#include "host/truth/film/tags/linear_light.hpp"

#include <cmath>
#include <cstddef>

namespace astro::film {

const std::array<float, 256>& linear_light() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> light{};
    for (std::size_t i = 0; i < light.size(); ++i) {
      const double value = static_cast<double>(i) / 255;
      light[i] =
          static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
    }
    return light;
  }();
  return table;
}

}  // namespace astro::film
