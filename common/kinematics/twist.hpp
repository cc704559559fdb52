#pragma once

#include <cstdint>

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

/// v -+ omega b / 2, with the calibrated b, so that a commanded spin turns by the commanded angle.
constexpr WheelSpeeds to_wheels(const Geometry& geometry, const BodyTwist& twist) {
  // b is at most 2 m, so that half of it times omega is no more than omega.
  const auto half = static_cast<std::int32_t>(
      mul_add(std::int64_t{1} << 29, geometry.half_base_30, twist.omega_uradps) >> 30);
  return {subtract_saturated(twist.v_umps, half), add_saturated(twist.v_umps, half)};
}

/// (R + L) / 2 and (R - L) / b.
constexpr BodyTwist to_body(const Geometry& geometry, const WheelSpeeds& wheels) {
  const std::int64_t difference = std::int64_t{wheels.right_umps} - wheels.left_umps;
  return {static_cast<std::int32_t>((std::int64_t{wheels.right_umps} + wheels.left_umps) >> 1),
          saturate32((difference * geometry.inverse_base_25 + (1 << 24)) >> 25)};
}

}  // namespace astro
