#pragma once

#include <cstdint>

#include "common/fixed/multiply.hpp"
#include "common/fixed/saturate.hpp"
#include "common/kinematics/geometry.hpp"

namespace astro {

/// Speeds in 1e-6 m/s and 1e-6 rad/s, which hold the decimal numbers that people type exactly.
struct WheelSpeeds {
  std::int32_t left_umps = 0;
  std::int32_t right_umps = 0;
  friend constexpr bool operator==(const WheelSpeeds&, const WheelSpeeds&) = default;
};

struct BodyTwist {
  std::int32_t v_umps = 0;
  std::int32_t omega_uradps = 0;
  friend constexpr bool operator==(const BodyTwist&, const BodyTwist&) = default;
};

/// Half the wheelbase of a commanded twist, in 2^-30 m. Its accelerations are converted with the same one, which is
/// exact as long as the curvature does not change.
inline std::int32_t half_base_30(const Geometry& geometry, const BodyTwist& twist) {
  const std::int32_t half = geometry.half_base_30;
  if (!geometry.effective_base.varies()) return half;
  return half + mul_high(half, geometry.effective_base.widening_32(twist.v_umps,
                                                                   mul_high(half, twist.omega_uradps)));
}

/// v -+ omega b / 2, with the calibrated b, so that a commanded spin turns by the commanded angle. Precondition, if b is
/// more than 1.6 m and e is not 0: omega is below 1,700 rad/s, since half the wheelbase may then be up to 1.2 m.
constexpr WheelSpeeds to_wheels(std::int32_t half_base_30, const BodyTwist& twist) {
  // With e = 0, b is at most 2 m, so that half of it times omega is no more than omega.
  const std::int32_t half = mul_rounded<30>(half_base_30, twist.omega_uradps);
  return {subtract_saturated(twist.v_umps, half), add_saturated(twist.v_umps, half)};
}
inline WheelSpeeds to_wheels(const Geometry& geometry, const BodyTwist& twist) {
  return to_wheels(half_base_30(geometry, twist), twist);
}

/// b over the effective wheelbase of measured speeds, minus 1, in 2^-32. Precondition: the effective base varies.
inline std::int32_t inverse_of_effective_base_32(const Geometry& geometry, const WheelSpeeds& wheels) {
  return geometry.effective_base.inverse_32(add_saturated(wheels.right_umps, wheels.left_umps),
                                            subtract_saturated(wheels.right_umps, wheels.left_umps));
}

/// The yaw rate of wheels that would turn about b by `omega_uradps`. A function of its own, because to_body() is used
/// in many places.
std::int32_t about_effective_base(const Geometry& geometry, const WheelSpeeds& wheels,
                                  std::int32_t omega_uradps);

/// (R + L) / 2 and (R - L) / b, with the effective wheelbase for b.
inline BodyTwist to_body(const Geometry& geometry, const WheelSpeeds& wheels) {
  const std::int64_t difference = std::int64_t{wheels.right_umps} - wheels.left_umps;
  std::int32_t omega_uradps = saturate32((difference * geometry.inverse_base_25 + (1 << 24)) >> 25);
  if (geometry.effective_base.varies()) omega_uradps = about_effective_base(geometry, wheels, omega_uradps);
  return {static_cast<std::int32_t>((std::int64_t{wheels.right_umps} + wheels.left_umps) >> 1), omega_uradps};
}

}  // namespace astro
