#pragma once

#include <cstdint>

#include "common/fixed/multiply.hpp"
#include "common/fixed/trig.hpp"
#include "common/fixed/wide.hpp"
#include "common/kinematics/pose.hpp"

namespace astro {

/// Moves a pose along exact arcs, T <- T * exp(travel, 0, turn), so that a steady turn gives the same pose at
/// any rate.
///
/// Domain  |travel| < 4 m and |turn| <= 1/8 turn per step; the robot refuses larger encoder steps.
/// Errors  Heading: none, because it is an integer sum. Position: the errors of the Q43 sine and the 32-bit
///         chord, less than 2e-10 of the travel. Nothing is rounded per step: travel below 2^-29 m, which a
///         product cannot hold, and position below 2^-40 m are carried to the next step.
/// Cost    constant, one sine and cosine, no division; callable from the control tick
/// Source  Sola, Deray, Atchuthan, arXiv:1812.01537v9, eqs. 156-158: the chord of an arc of length s and
///         angle a is s * sin(a/2) / (a/2), and points along the mean of the headings at both ends
class ArcIntegrator {
 public:
  /// `travel` in 2^-61 m, `turn` in 2^-64 turn. Always inlined, because both callers are in the tick.
  [[gnu::always_inline]] void advance(std::int64_t travel, std::int64_t turn) {
    advance(travel, turn, sin_cos(pose_.theta + (turn >> 1)));
  }
  /// The same bits as advance(travel, 0), for a caller who has the sine and cosine of the heading.
  [[gnu::always_inline]] void advance_straight(std::int64_t travel, const SinCos& heading) {
    advance(travel, 0, heading);
  }
  /// The same bits as advance(0, turn), without a sine and a cosine.
  void spin(std::int64_t turn) {
    std::uint64_t theta = pose_.theta.raw();
    accumulate(pose_.turns, theta, turn);
    pose_.theta = Angle::from_raw(theta);
  }

  const Pose& pose() const { return pose_; }
  /// Continues from `pose`; carried remainders are dropped.
  void set_pose(const Pose& pose) {
    *this = ArcIntegrator{};
    pose_ = pose;
  }

 private:
  /// `heading`: halfway through the turn.
  [[gnu::always_inline]] void advance(std::int64_t travel, std::int64_t turn, const SinCos& heading);
  static std::int32_t chord_deficit(std::int64_t turn);

  Pose pose_;
  std::uint32_t remainder_ = 0;            // 2^-61 m, less than 2^-29 m: travel not yet in the position
  std::uint32_t x_rest_ = 0, y_rest_ = 0;  // 2^-72 m, less than 2^-40 m: position not yet in the pose
};

// 1 - sin(h)/h for h = turn / 2, 32 fraction bits. With |turn| <= 1/8 turn, h^2 < 0.16, and the first omitted
// term h^8 / 9! is below 2e-9; at 1 kHz it is below 1e-26.
inline std::int32_t ArcIntegrator::chord_deficit(std::int64_t turn) {
  const auto turn_33 = static_cast<std::int32_t>(turn >> 31);
  const std::int32_t square_34 = mul_high(turn_33, turn_33);
  // h = pi turn. Each product with the square, which has 34 fraction bits, gains two bits.
  constexpr double kPi2 = 9.869604401089358;
  constexpr auto k1_30 = static_cast<std::int32_t>(kPi2 / 6 * 0x1p30 + 0.5);
  constexpr auto k2_28 = static_cast<std::int32_t>(kPi2 * kPi2 / 120 * 0x1p28 + 0.5);
  constexpr auto k3_26 = static_cast<std::int32_t>(kPi2 * kPi2 * kPi2 / 5040 * 0x1p26 + 0.5);
  return mul_high(square_34, k1_30 - mul_high(square_34, k2_28 - mul_high(square_34, k3_26)));
}

inline void ArcIntegrator::advance(std::int64_t travel, std::int64_t turn, const SinCos& heading) {
  const std::int64_t lost = mul_wide(static_cast<std::int32_t>(travel >> 32), chord_deficit(turn));
  const std::int64_t chord = travel - lost + remainder_;
  const auto step_29 = static_cast<std::int32_t>(chord >> 32);
  remainder_ = static_cast<std::uint32_t>(chord);

  accumulate(pose_.x, x_rest_, heading.cos, step_29);
  accumulate(pose_.y, y_rest_, heading.sin, step_29);

  spin(turn);
}

}  // namespace astro
