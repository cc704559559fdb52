#pragma once

#include <cstdint>
#include <vector>

namespace astro::support::film {

/// Grey noise with grains of 12 mm, 60 mm and 0.4 m, as of a worn floor, repeated every 8 m. Mean 0, nearly all within +-1.
class FloorTexture {
 public:
  explicit FloorTexture(std::uint64_t seed = 1);
  float at(float x_m, float y_m) const;

 private:
  struct Octave {
    float per_m, weight;
  };
  static constexpr int kSize = 1024;  // grains each way of the finest octave
  float grain(float x, float y) const;
  std::vector<float> grains_;
};

}  // namespace astro::support::film
