#include "common/kinematics/odometry.hpp"

#include "common/fixed/multiply.hpp"
#include "common/fixed/trig.hpp"
#include "common/fixed/wide.hpp"

namespace astro {
namespace {

// 1 - sin(h)/h for h = turn / 2, 32 fraction bits. |turn| < 1/4 turn, so that h^2 < 0.62 and the first term
// left out, h^10 / 11!, is below 3e-9 there and below 1e-30 at 1 kHz.
std::int32_t chord_deficit(std::int64_t turn) {
  const auto turn_33 = static_cast<std::int32_t>(turn >> 31);
  const std::int32_t square_34 = mul_high(turn_33, turn_33);
  // h = pi turn, and each product with a square of 34 fraction bits gains two.
  constexpr double kPi2 = 9.869604401089358;
  constexpr auto k1_30 = static_cast<std::int32_t>(kPi2 / 6 * 0x1p30 + 0.5);
  constexpr auto k2_28 = static_cast<std::int32_t>(kPi2 * kPi2 / 120 * 0x1p28 + 0.5);
  constexpr auto k3_26 = static_cast<std::int32_t>(kPi2 * kPi2 * kPi2 / 5040 * 0x1p26 + 0.5);
  constexpr auto k4_24 = static_cast<std::int32_t>(kPi2 * kPi2 * kPi2 * kPi2 / 362880 * 0x1p24 + 0.5);
  const std::int32_t sum_26 = k3_26 - mul_high(square_34, k4_24);
  const std::int32_t sum_28 = k2_28 - mul_high(square_34, sum_26);
  return mul_high(square_34, k1_30 - mul_high(square_34, sum_28));
}

}  // namespace

void ArcIntegrator::advance(std::int64_t travel, std::int64_t turn) {
  const std::int64_t lost = mul_wide(static_cast<std::int32_t>(travel >> 32), chord_deficit(turn));
  const std::int64_t chord = travel - lost + remainder_;
  const auto step_29 = static_cast<std::int32_t>(chord >> 32);
  remainder_ = static_cast<std::uint32_t>(chord);

  const SinCos heading = sin_cos(pose_.theta + (turn >> 1));
  pose_.x += mul_carry(heading.cos, step_29, x_rest_);
  pose_.y += mul_carry(heading.sin, step_29, y_rest_);

  const Angle before = pose_.theta;
  pose_.theta = before + turn;
  const bool carried = pose_.theta.raw() < before.raw();
  pose_.turns += (turn < 0 ? -1 : 0) + (carried ? 1 : 0);
}

void Odometry::advance(std::int32_t left_counts, std::int32_t right_counts) {
  integrator_.advance(
      mul_low(geometry_.left.half_travel, left_counts) + mul_low(geometry_.right.half_travel, right_counts),
      mul_low(geometry_.right.turn, right_counts) - mul_low(geometry_.left.turn, left_counts));
}

}  // namespace astro
