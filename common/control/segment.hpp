#pragma once

#include <cstdint>

#include "common/params/parameter_set.hpp"

namespace astro {

/// One piece of a path, driven from rest to rest at a constant curvature.
///
///   line   angle 0
///   spin   length 0
///   arc    both; the sign of length means forward or backward, the sign of angle the direction of the turn
///   stop   neither, and a time to wait
struct Segment {
  std::int64_t length_nm = 0;        // of the path of the robot's centre
  std::int64_t angle_32 = 0;         // heading change, 2^-32 turn
  std::int32_t speed_umps = 0;       // at most this; 0: as fast as the robot's limits allow
  std::int32_t yaw_rate_uradps = 0;  // at most this; 0: as fast as the robot's limits allow
  std::int32_t dwell_ms = 0;         // only without length and angle
};

/// Limits of what is commanded. The jerk limits apply to velocities only: segments have trapezoidal profiles.
struct MotionLimits {
  std::int32_t speed_umps = 0, yaw_rate_uradps = 0;
  std::int32_t acceleration_umps2 = 0, yaw_acceleration_uradps2 = 0;
  std::int32_t jerk_mmps3 = 0, yaw_jerk_mradps3 = 0;  // 0: none
};

MotionLimits make_limits(const ParameterSet& set);

/// The longest segment: 1 km, 500 turns, four hours.
inline constexpr std::int64_t kMaxLength_nm = 1'000'000'000'000;
inline constexpr std::int64_t kMaxAngle_32 = std::int64_t{500} << 32;
inline constexpr std::int64_t kMaxTicks = std::int64_t{4} * 3600 * 1000;

}  // namespace astro
