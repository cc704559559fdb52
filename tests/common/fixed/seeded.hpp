#pragma once

#include <cstdint>
#include <cstdio>
#include <random>

namespace astro::tests {

/// Random numbers from a fixed seed, which is printed, so that a failure can be repeated.
class Seeded {
 public:
  explicit Seeded(std::uint64_t seed) : engine_(seed) {
    std::printf("  seed %llu\n", static_cast<unsigned long long>(seed));
  }

  std::uint64_t bits() { return engine_(); }

  /// Uniform in [low, high].
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(engine_);
  }
  std::int32_t between32(std::int32_t low, std::int32_t high) {
    return static_cast<std::int32_t>(between(low, high));
  }

  /// Any size from 1 bit to `most` bits with equal chance, any sign: extremes come up, unlike in uniform
  /// numbers.
  std::int64_t any_size(int most) {
    const int size = static_cast<int>(between(1, most));
    const auto value = static_cast<std::int64_t>(bits() >> (64 - size));
    return (bits() & 1U) != 0 ? -value : value;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace astro::tests
