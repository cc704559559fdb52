#include "tests/support/film/picture/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace astro::support::film {
namespace {

struct Measured {
  double mean, sd;
};

/// Of many pixels of the same light.
Measured developed(const SensorModel& model, float light) {
  constexpr int kSize = 400;
  Sensor sensor(model, kSize, kSize, 3);
  Plane even(Window{0, 0, kSize, kSize});
  for (int v = 0; v < kSize; ++v) std::fill(even.row(v), even.row(v) + kSize, light);
  std::vector<std::uint8_t> picture(static_cast<std::size_t>(kSize * kSize));
  sensor.expose(sensor.develop(even), picture.data());
  double sum = 0, squares = 0;
  for (const std::uint8_t number : picture) sum += number, squares += number * number;
  const double mean = sum / static_cast<double>(picture.size());
  return {mean, std::sqrt(squares / static_cast<double>(picture.size()) - mean * mean)};
}

SensorModel without_vignetting() {
  SensorModel model;
  model.vignetting = 0;
  return model;
}

TEST(Sensor, FollowsTheStandardsToneCurve) {
  SensorModel model = without_vignetting();
  model.read_noise = model.shot_noise = 0;
  // Published values of sRGB: middle grey 0.2140 is 0.5, 0.5 is 0.7354.
  EXPECT_NEAR(developed(model, 0.2140F).mean, 16 + 219 * 0.5, 0.51);  // half a number is what rounding leaves
  EXPECT_NEAR(developed(model, 0.5F).mean, 16 + 219 * 0.7354, 0.51);
  EXPECT_EQ(developed(model, 0).mean, 16);
  EXPECT_EQ(developed(model, 1).mean, 235);
  for (double light = 0.02; light < 1; light += 0.07)
    EXPECT_NEAR(light_of(model, developed(model, static_cast<float>(light)).mean), light, 0.005);
}

TEST(Sensor, HasTheNoiseThatWasAskedFor) {
  SensorModel model = without_vignetting();
  model.tone = Tone::power;
  model.gamma = 1;
  model.read_noise = 0.01;
  model.shot_noise = 4e-4;
  for (const double light : {0.1, 0.5, 0.8}) {
    const Measured measured = developed(model, static_cast<float>(light));
    const double sd = 219 * std::sqrt(0.01 * 0.01 + 4e-4 * light);
    EXPECT_NEAR(measured.mean, 16 + 219 * light, 0.05);
    EXPECT_NEAR(measured.sd, std::hypot(sd, std::sqrt(1.0 / 12)),
                0.02 * sd);  // 160000 pixels of a pool of a million
  }
}

TEST(Sensor, IsDarkerInTheCornersByTheVignetting) {
  SensorModel model;
  model.tone = Tone::power;
  model.gamma = 1;
  model.read_noise = model.shot_noise = 0;
  model.vignetting = 0.3;
  Sensor sensor(model, 101, 51, 3);
  Plane even(Window{0, 0, 101, 51});
  for (int v = 0; v < 51; ++v) std::fill(even.row(v), even.row(v) + 101, 0.8F);
  std::vector<std::uint8_t> picture(101 * 51);
  sensor.expose(sensor.develop(even), picture.data());
  EXPECT_NEAR(picture[25 * 101 + 50], 16 + 219 * 0.8, 0.51);
  EXPECT_NEAR(picture[0], 16 + 219 * 0.8 * 0.7, 0.51);
  EXPECT_NEAR(picture[101 * 51 - 1], 16 + 219 * 0.8 * 0.7, 0.51);
}

}  // namespace
}  // namespace astro::support::film
