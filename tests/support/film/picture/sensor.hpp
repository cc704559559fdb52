#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/film/picture/plane.hpp"

/// From light to the numbers of a video: vignetting, tone curve, noise, 8 bits.
namespace astro::support::film {

enum class Tone { srgb, power };  // power: light^(1 / gamma)

struct SensorModel {
  Tone tone = Tone::srgb;
  double gamma = 2.2;     // of Tone::power; 1: linear
  double exposure = 1.0;  // factor before clipping at 1
  double vignetting =
      0.15;  // part of the light that is missing in the corners; grows with the square of the distance
  // Noise of a pixel, as part of full scale in linear light: sqrt(read^2 + shot * light). Its values are not correlated.
  double read_noise = 0.002, shot_noise = 1e-4;
};

/// A part of a picture after the tone curve, before noise: 128 steps to a number of the video.
struct Developed {
  Window window;
  std::vector<std::int16_t> value, noise_sd;  // row after row
};

/// Video numbers run from 16 (black) to 235 (white), as of H.264 with limited range.
class Sensor {
 public:
  Sensor(const SensorModel& model, int width_px, int height_px, std::uint64_t seed);

  Developed develop(const Plane& light) const;
  /// Writes the pixels of a developed part into a picture, with noise. `picture` is the whole one.
  void expose(const Developed& part, std::uint8_t* picture);

 private:
  std::int16_t random_offset();

  SensorModel model_;
  int width_px_, height_px_;
  std::vector<float> value_, noise_sd_;  // by light
  std::vector<std::int16_t> noise_;      // drawn once; each row of each picture begins somewhere else in it
  std::mt19937_64 random_;
};

/// The light that the tone curve turns into this number of the video; the inverse of the curve alone.
double light_of(const SensorModel& model, double video_number);

}  // namespace astro::support::film
