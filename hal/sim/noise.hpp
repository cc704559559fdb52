#pragma once

#include <cmath>
#include <cstdint>

/// Random numbers without a generator: each is a pure function of (seed, stream, index), so the noise at the
/// n-th millimetre of a wheel does not depend on the numbers that were drawn before.
///
/// Source  mixing: Steele, Lea, Flood, "Fast splittable pseudorandom number generators" (SplitMix64), 2014.
///         normal deviate: Wichura, algorithm AS 241 (PPND7), 1988; good to 7 digits, far past what noise
///         needs.
namespace astro::sim {

constexpr std::uint64_t scramble(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58'476D'1CE4'E5B9U;
  z = (z ^ (z >> 27)) * 0x94D0'49BB'1331'11EBU;
  return z ^ (z >> 31);
}

inline constexpr std::uint64_t kGolden = 0x9E37'79B9'7F4A'7C15U;

/// What all numbers of a stream have in common, for who draws many of them.
constexpr std::uint64_t stream_key(std::uint64_t seed, std::uint64_t stream) {
  return scramble(scramble(seed + kGolden) ^ ((stream + 1) * kGolden));
}
constexpr std::uint64_t hash(std::uint64_t key, std::uint64_t index) {
  return scramble(key + (index + 1) * kGolden);
}
constexpr std::uint64_t hash(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  return hash(stream_key(seed, stream), index);
}

/// Quantile of the standard normal distribution; p in (0, 1).
inline double normal_quantile(double p) {
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * (((59.109374720 * r + 159.29113202) * r + 50.434271938) * r + 3.3871327179) /
           (((67.187563600 * r + 78.757757664) * r + 17.895169469) * r + 1.0);
  }
  double r = std::sqrt(-std::log(q < 0.0 ? p : 1.0 - p));
  double x;
  if (r <= 5.0) {
    r -= 1.6;
    x = (((0.17023821103 * r + 1.3067284816) * r + 2.7568153900) * r + 1.4234372777) /
        ((0.12021132975 * r + 0.73700164250) * r + 1.0);
  } else {
    r -= 5.0;
    x = (((0.017337203997 * r + 0.42868294337) * r + 3.0812263860) * r + 6.6579051150) /
        ((0.012258202635 * r + 0.24197894225) * r + 1.0);
  }
  return std::copysign(x, q);
}

/// Standard normal deviate number `index` of a stream.
inline double gauss(std::uint64_t key, std::uint64_t index) {
  const double p = (static_cast<double>(hash(key, index) >> 11) + 0.5) * 0x1p-53;
  return normal_quantile(p);
}
inline double gauss(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  return gauss(stream_key(seed, stream), index);
}

}  // namespace astro::sim
