#pragma once

#include <cstdint>

#include "common/control/wheel_controller.hpp"
#include "common/fixed/saturate.hpp"
#include "common/kinematics/twist.hpp"
#include "common/params/parameter_set.hpp"

namespace astro {

/// What the motors get, forward positive.
struct WheelVoltages {
  std::int32_t left_uv = 0, right_uv = 0;
};

/// The gains of both wheels and of their coupling. Takes divisions: made outside the tick.
struct PairGains {
  PairGains(const ParameterSet& set);  // NOLINT(google-explicit-constructor): a set's gains

  WheelTerms left, right;
  std::int32_t k_sync = 0;  // 2^-32 um/s per nm
};

/// Speed control of both wheels as one machine, so that what happens to one wheel does not turn the robot.
///
/// Coupling    how far the left wheel has fallen behind the right one, against what was wanted of both,
///
///               D = integral (e_L - e_R) dt,   e_L' = e_L + k_sync D,   e_R' = e_R - k_sync D
///
///             so the other wheel waits for the one that is held up, and both catch up until D is 0 again:
///             the heading recovers, which a speed loop for each wheel alone never does.
/// Saturation  while a wheel is at the end of the supply both set points shrink by one common factor, and
///             grow again when it is not: the robot is slower on the same curve.
///
/// Units   speeds 1e-6 m/s, acceleration 1e-6 m/s^2, voltages 1e-6 V; one call a tick (1 ms).
/// Cost    constant, no division; callable from the control tick.
/// Source  cross-coupling: Borenstein & Koren, "Motion control analysis of a mobile robot", 1987.
class WheelPair {
 public:
  /// Without a bump, if told what the last advance() was told.
  void set_gains(const PairGains& gains, const WheelSpeeds& set_points = {},
                 const WheelSpeeds& accelerations = {}, const WheelSpeeds& measured = {});

  /// Each voltage is within +-limit_uv.
  WheelVoltages advance(const WheelSpeeds& set_points, const WheelSpeeds& accelerations,
                        const WheelSpeeds& measured, std::int32_t limit_uv);
  void reset();

  /// What is left of the set points for want of voltage, 2^-16.
  std::int32_t share() const { return share_16_; }

 private:
  static constexpr std::int32_t kWhole = 1 << 16;
  // From whole to nothing and back in a second: slower than the speed loops, faster than a person.
  static constexpr std::int32_t kShareStep = 65;
  static constexpr int kBehindBits = 28;  // of 1e-9 m: 134 mm

  struct Points {
    WheelPoint left, right;
  };

  Points points(const WheelSpeeds& wanted, const WheelSpeeds& accelerations,
                const WheelSpeeds& measured) const;
  WheelSpeeds shrunk(const WheelSpeeds& set_points) const;
  /// A tick at the end of the supply, or one that is not.
  void note(bool limited);

  WheelController left_, right_;
  std::int32_t k_sync_ = 0;     // 2^-32 um/s per nm
  std::int32_t behind_nm_ = 0;  // D
  std::int32_t share_16_ = kWhole;
  bool limited_ = false;  // in the last tick
};

inline WheelSpeeds WheelPair::shrunk(const WheelSpeeds& set_points) const {
  if (share_16_ == kWhole) return set_points;
  return {static_cast<std::int32_t>(mul_wide(set_points.left_umps, share_16_) >> 16),
          static_cast<std::int32_t>(mul_wide(set_points.right_umps, share_16_) >> 16)};
}

inline WheelVoltages WheelPair::advance(const WheelSpeeds& wanted, const WheelSpeeds& accelerations,
                                        const WheelSpeeds& measured, std::int32_t limit_uv) {
  const WheelSpeeds set_points = shrunk(wanted);
  const std::int32_t left_error = subtract_saturated(set_points.left_umps, measured.left_umps);
  const std::int32_t right_error = subtract_saturated(set_points.right_umps, measured.right_umps);
  const std::int32_t catch_up = mul_high(behind_nm_, k_sync_);
  behind_nm_ =
      saturate_to<kBehindBits>(add_saturated(behind_nm_, subtract_saturated(left_error, right_error)));
  bool limited = false;
  const WheelVoltages voltages{left_.advance(set_points.left_umps, accelerations.left_umps,
                                             add_saturated(left_error, catch_up), limit_uv, limited),
                               right_.advance(set_points.right_umps, accelerations.right_umps,
                                              subtract_saturated(right_error, catch_up), limit_uv, limited)};
  if (limited || share_16_ != kWhole) note(limited);
  return voltages;
}

}  // namespace astro
