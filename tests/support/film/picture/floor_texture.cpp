#include "tests/support/film/picture/floor_texture.hpp"

#include <cmath>
#include <random>

namespace astro::support::film {

FloorTexture::FloorTexture(std::uint64_t seed) : grains_(static_cast<std::size_t>(kSize) * kSize) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (float& grain : grains_) grain = uniform(random);
}

float FloorTexture::at(float x_m, float y_m) const {
  constexpr Octave kOctaves[] = {{1 / 0.012F, 0.5F}, {1 / 0.06F, 0.5F}, {1 / 0.4F, 0.7F}};
  float sum = 0;
  for (const Octave& octave : kOctaves) sum += octave.weight * grain(x_m * octave.per_m, y_m * octave.per_m);
  return sum;
}

float FloorTexture::grain(float x, float y) const {
  const float left = std::floor(x), low = std::floor(y), right_part = x - left, high_part = y - low;
  const auto wrapped = [](float whole) {
    return static_cast<std::size_t>(static_cast<int>(whole) & (kSize - 1));
  };
  const std::size_t i = wrapped(left), i1 = wrapped(left + 1);
  const float* const row = &grains_[wrapped(low) * kSize];
  const float* const above = &grains_[wrapped(low + 1) * kSize];
  const float lower = row[i] + right_part * (row[i1] - row[i]);
  const float upper = above[i] + right_part * (above[i1] - above[i]);
  return lower + high_part * (upper - lower);
}

}  // namespace astro::support::film
