#include "tests/support/film/picture/sensor.hpp"

#include <cmath>

namespace astro::support::film {
namespace {

constexpr int kSteps = 4096;        // of light, in the tables
constexpr double kPerNumber = 128;  // steps of Developed
constexpr double kBlack = 16, kRange = 219;
constexpr int kNoiseBits = 12;  // of a standard deviation in noise_
constexpr std::size_t kNoiseValues = std::size_t{1} << 20;

double encoded(const SensorModel& model, double light) {
  if (model.tone == Tone::power) return std::pow(light, 1 / model.gamma);
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

double decoded(const SensorModel& model, double value) {
  if (model.tone == Tone::power) return std::pow(value, model.gamma);
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace

Sensor::Sensor(const SensorModel& model, int width_px, int height_px, std::uint64_t seed)
    : model_(model), width_px_(width_px), height_px_(height_px), random_(seed) {
  for (int step = 0; step <= kSteps + 1; ++step) {
    const double light = std::min(1.0, static_cast<double>(step) / kSteps);
    value_.push_back(static_cast<float>((kBlack + kRange * encoded(model, light)) * kPerNumber));
    const double sd = std::sqrt(model.read_noise * model.read_noise + model.shot_noise * light);
    const double low = std::max(0.0, light - 1e-3), high = std::min(1.0, light + 1e-3);
    const double slope = (encoded(model, high) - encoded(model, low)) / (high - low);
    noise_sd_.push_back(static_cast<float>(std::min(20.0, kRange * sd * slope) * kPerNumber));
  }
  std::normal_distribution<double> normal;
  noise_.reserve(kNoiseValues + static_cast<std::size_t>(width_px));
  while (noise_.size() < kNoiseValues + static_cast<std::size_t>(width_px)) {
    const double value = std::clamp(normal(random_), -6.0, 6.0) * (1 << kNoiseBits);
    noise_.push_back(static_cast<std::int16_t>(std::lround(value)));
  }
}

Developed Sensor::develop(const Plane& light) const {
  const Window& window = light.window();
  Developed part{window, {}, {}};
  const auto size = static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height());
  part.value.resize(size);
  part.noise_sd.resize(size);
  const double middle_u = (width_px_ - 1) / 2.0, middle_v = (height_px_ - 1) / 2.0;
  const auto missing = static_cast<float>(model_.vignetting / (middle_u * middle_u + middle_v * middle_v));
  std::size_t at = 0;
  for (int v = window.top; v < window.bottom; ++v) {
    const float* const row = light.row(v);
    const auto dv = static_cast<float>(v - middle_v);
    for (int u = window.left; u < window.right; ++u, ++at) {
      const auto du = static_cast<float>(u - middle_u);
      const float shade = static_cast<float>(model_.exposure) * (1 - missing * (du * du + dv * dv));
      const float place = std::clamp(row[u] * shade, 0.0F, 1.0F) * kSteps;
      const auto step = static_cast<std::size_t>(place);
      const float part_of_step = place - static_cast<float>(step);
      part.value[at] =
          static_cast<std::int16_t>(value_[step] + part_of_step * (value_[step + 1] - value_[step]) + 0.5F);
      part.noise_sd[at] = static_cast<std::int16_t>(noise_sd_[step] + 0.5F);
    }
  }
  return part;
}

void Sensor::expose(const Developed& part, std::uint8_t* picture) {
  const Window& window = part.window;
  const int width = window.width();
  for (int row = 0; row < window.height(); ++row) {
    const auto from = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
    const std::int16_t* const value = &part.value[from];
    const std::int16_t* const sd = &part.noise_sd[from];
    const std::int16_t* const noise = &noise_[random_() % kNoiseValues];
    std::uint8_t* const out =
        picture + static_cast<std::size_t>(window.top + row) * static_cast<std::size_t>(width_px_) +
        window.left;
    for (int u = 0; u < width; ++u) {
      const int noisy = value[u] + ((noise[u] * sd[u]) >> kNoiseBits) + 64;
      const int number = noisy >> 7;
      out[u] = static_cast<std::uint8_t>(number < 0 ? 0 : number > 255 ? 255 : number);
    }
  }
}

double light_of(const SensorModel& model, double video_number) {
  return decoded(model, std::clamp((video_number - kBlack) / kRange, 0.0, 1.0));
}

}  // namespace astro::support::film
