#pragma once

#include <cstdint>

namespace astro {

/// Binary angle: 2^64 is one turn, so sums wrap by themselves and are never rounded.
class Angle {
 public:
  constexpr Angle() = default;
  static constexpr Angle from_raw(std::uint64_t raw) {
    Angle angle;
    angle.raw_ = raw;
    return angle;
  }
  constexpr std::uint64_t raw() const { return raw_; }

  /// `turn` in 2^-64 turn, any sign.
  friend constexpr Angle operator+(Angle a, std::int64_t turn) {
    return from_raw(a.raw_ + static_cast<std::uint64_t>(turn));
  }
  /// The shorter turn from b to a, in 2^-64 turn, in [-1/2, 1/2) turn.
  friend constexpr std::int64_t operator-(Angle a, Angle b) {
    return static_cast<std::int64_t>(a.raw_ - b.raw_);
  }
  friend constexpr bool operator==(Angle, Angle) = default;

 private:
  std::uint64_t raw_ = 0;
};

}  // namespace astro
