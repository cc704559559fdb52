#pragma once

#include <cstdint>

/// Places inside a pixel and moments inside an exposure at which light is sampled. Neighbouring pixels have different ones, and
/// in each pixel they fill width, height and time evenly, so that the mean over an edge of many pixels has no bias.
namespace astro::support::film {

struct PixelSample {
  float u, v;  // -0.5 to 0.5
  int moment;
};

/// Additive recurrence by the plastic number, shifted by a hash of the pixel.
/// Source  M. Roberts, The unreasonable effectiveness of quasirandom sequences, 2018.
class PixelSamples {
 public:
  PixelSamples(int u, int v, int moments) : moments_(static_cast<std::uint32_t>(moments)) {
    std::uint32_t hash =
        static_cast<std::uint32_t>(u) * 0x9E3779B1U ^ static_cast<std::uint32_t>(v) * 0x85EBCA77U;
    hash = (hash ^ hash >> 15) * 0x2C1B3C6DU;
    u_ = (hash ^ hash >> 12) * 0x297A2D39U;
    v_ = u_ * 0x9E3779B1U ^ u_ >> 13;
    moment_ = v_ * 0x85EBCA77U ^ v_ >> 16;
  }

  PixelSample next() {
    u_ += 3518319155U;       // 2^32 / 1.2207440846
    v_ += 2882110345U;       // 2^32 / 1.2207440846^2
    moment_ += 2360945575U;  // 2^32 / 1.2207440846^3
    constexpr float kUnit = 1.0F / 4294967296.0F;
    return {static_cast<float>(u_) * kUnit - 0.5F, static_cast<float>(v_) * kUnit - 0.5F,
            static_cast<int>(static_cast<std::uint64_t>(moment_) * moments_ >> 32)};
  }

 private:
  std::uint32_t u_, v_, moment_, moments_;
};

}  // namespace astro::support::film
