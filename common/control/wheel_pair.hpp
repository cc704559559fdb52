#pragma once

#include <cstdint>

#include "common/control/wheel_controller.hpp"
#include "common/fixed/saturate.hpp"
#include "common/kinematics/twist.hpp"
#include "common/params/parameter_set.hpp"

namespace astro {

/// Motor voltages, forward positive.
struct WheelVoltages {
  std::int32_t left_uv = 0, right_uv = 0;
};

/// The gains of both wheels and of their coupling. They take divisions, so they are computed outside the
/// tick.
struct PairGains {
  PairGains(const ParameterSet& set);  // NOLINT(google-explicit-constructor): a set's gains

  WheelTerms left, right;
  std::int32_t k_sync = 0;  // 2^-32 um/s per nm
};

/// Speed control of both wheels together, so that a disturbance of one wheel does not turn the robot.
///
/// Coupling    D is how far the left wheel has fallen behind the right one, each compared with its set point:
///
///               D = integral (e_L - e_R) dt,   e_L' = e_L + k_sync D,   e_R' = e_R - k_sync D
///
///             The undisturbed wheel waits for the other one, and both catch up until D is 0 again. So the
///             heading recovers, which it does not with a separate speed loop for each wheel.
/// Saturation  while a wheel needs more voltage than the supply has, one common factor reduces both set
///             points; afterwards it grows again. The robot is slower on the same curve.
///
/// Units   speeds 1e-6 m/s, acceleration 1e-6 m/s^2, voltages 1e-6 V; one call a tick (1 ms).
/// Cost    constant, no division; callable from the control tick.
/// Source  cross-coupling: Borenstein & Koren, "Motion control analysis of a mobile robot", 1987.
class WheelPair {
 public:
  /// Bumpless if the arguments are those of the last advance().
  void set_gains(const PairGains& gains, const WheelSpeeds& set_points = {},
                 const WheelSpeeds& accelerations = {}, const WheelSpeeds& measured = {});

  /// Each voltage is within +-limit_uv.
  WheelVoltages advance(const WheelSpeeds& set_points, const WheelSpeeds& accelerations,
                        const WheelSpeeds& measured, std::int32_t limit_uv);
  void reset();

  /// The factor that reduces the set points while the voltage is limited, in 2^-16.
  std::int32_t share() const { return share_16_; }

 private:
  static constexpr std::int32_t kWhole = 1 << 16;
  // From 1 to 0 and back takes a second: slower than the speed loops, faster than a person notices.
  static constexpr std::int32_t kShareStep = 65;
  static constexpr int kBehindBits = 28;  // of 1e-9 m: 134 mm

  struct Points {
    WheelPoint left, right;
    std::int32_t behind_umps;  // by how much the left wheel is falling behind the right one: e_L - e_R
  };

  /// What both controllers work on.
  Points points(const WheelSpeeds& wanted, const WheelSpeeds& accelerations,
                const WheelSpeeds& measured) const;
  WheelSpeeds shrunk(const WheelSpeeds& set_points) const;
  /// Adapts the factor after a tick whose voltage was limited, or was not.
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

inline WheelPair::Points WheelPair::points(const WheelSpeeds& wanted, const WheelSpeeds& accelerations,
                                           const WheelSpeeds& measured) const {
  const WheelSpeeds set_points = shrunk(wanted);
  const std::int32_t left = subtract_saturated(set_points.left_umps, measured.left_umps);
  const std::int32_t right = subtract_saturated(set_points.right_umps, measured.right_umps);
  const std::int32_t catch_up = mul_high(behind_nm_, k_sync_);
  return {{set_points.left_umps, accelerations.left_umps, add_saturated(left, catch_up)},
          {set_points.right_umps, accelerations.right_umps, subtract_saturated(right, catch_up)},
          subtract_saturated(left, right)};
}

inline WheelVoltages WheelPair::advance(const WheelSpeeds& wanted, const WheelSpeeds& accelerations,
                                        const WheelSpeeds& measured, std::int32_t limit_uv) {
  const Points at = points(wanted, accelerations, measured);
  behind_nm_ = saturate_to<kBehindBits>(add_saturated(behind_nm_, at.behind_umps));
  bool limited = false;
  const WheelVoltages voltages{left_.advance(at.left, limit_uv, limited),
                               right_.advance(at.right, limit_uv, limited)};
  if (limited || share_16_ != kWhole) note(limited);
  return voltages;
}

}  // namespace astro
