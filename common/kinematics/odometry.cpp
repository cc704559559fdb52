#include "common/kinematics/odometry.hpp"

#include "common/fixed/trig.hpp"
#include "common/fixed/wide.hpp"

namespace astro {
namespace {

// 1 - sin(h)/h for h = turn / 2, 32 fraction bits. |turn| < 1/4 turn, so that h^2 < 0.62 and the first term
// left out, h^10 / 11!, is below 2e-9 there and below 1e-30 at 1 kHz.
std::int32_t chord_deficit(std::int64_t turn) {
  constexpr std::int64_t kPiSquared_28 = 2649351758;  // pi^2 * 2^28
  const std::int64_t half_turns_33 = turn >> 31;      // turn in 2^-33: 31 bits and sign
  const std::int64_t square_35 = (half_turns_33 * half_turns_33 + (1 << 30)) >> 31;
  const std::int64_t h2 = (square_35 * kPiSquared_28 + (1 << 30)) >> 31;  // (pi * turn)^2, 32 bits

  constexpr std::int64_t kOver6 = 715827883, kOver120 = 35791394, kOver5040 = 852176, kOver362880 = 11836;
  std::int64_t sum = kOver5040 - ((h2 * kOver362880) >> 32);
  sum = kOver120 - ((h2 * sum) >> 32);
  sum = kOver6 - ((h2 * sum) >> 32);
  return static_cast<std::int32_t>((h2 * sum + (std::int64_t{1} << 31)) >> 32);
}

}  // namespace

void ArcIntegrator::advance(std::int64_t travel, std::int64_t turn) {
  const std::int64_t chord = travel - mul_shift<32>(travel, chord_deficit(turn)) + remainder_;
  const auto step_29 = static_cast<std::int32_t>(chord >> 27);
  remainder_ = chord & ((std::int64_t{1} << 27) - 1);

  const SinCos heading = sin_cos(pose_.theta + (turn >> 1));
  pose_.x += mul_shift_carry<29>(heading.cos, step_29, x_rest_);
  pose_.y += mul_shift_carry<29>(heading.sin, step_29, y_rest_);

  const Angle before = pose_.theta;
  pose_.theta = before + turn;
  const bool carried = pose_.theta.raw() < before.raw();
  pose_.turns += (turn < 0 ? -1 : 0) + (carried ? 1 : 0);
}

void Odometry::advance(std::int32_t left_counts, std::int32_t right_counts) {
  integrator_.advance(geometry_.left.half_travel * left_counts + geometry_.right.half_travel * right_counts,
                      geometry_.right.turn * right_counts - geometry_.left.turn * left_counts);
}

}  // namespace astro
