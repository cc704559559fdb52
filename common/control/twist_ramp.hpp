#pragma once

#include <cstdint>

#include "common/control/segment.hpp"
#include "common/kinematics/twist.hpp"

namespace astro {

/// A velocity that approaches a target within limits of acceleration and jerk, and then equals it exactly.
/// From rest or a steady velocity, speed and yaw rate take the same time and their ratio changes evenly, so a
/// robot that starts into a curve is on that curve from the first millimetre. If the target changes during a
/// ramp, each of the two approaches it as fast as its own limits allow. The velocity never leaves the range
/// between the start and the targets so far.
///
/// Units   1e-6 m/s, 1e-6 rad/s; one advance() a tick (1 ms).
/// Cost    set_target: some divisions. advance: constant, four 64-bit multiplies; callable from the tick.
class TwistRamp {
 public:
  /// Limits of one component, per tick.
  struct Limits {
    std::int64_t acceleration = 1, jerk = 1;
  };
  /// The limits of both components. They take divisions, so they are computed outside the tick.
  struct Rates {
    Rates() = default;
    explicit Rates(const MotionLimits& limits);
    Limits v, omega;
  };

  /// Valid from the next target on.
  void set_rates(const Rates& rates) { rates_ = rates; }

  /// Sets the target. The same target again changes nothing.
  void set_target(const BodyTwist& target);
  /// Takes over the target of `planned`, a copy that got its target outside the tick.
  void take_target(const TwistRamp& planned);
  /// Sets a steady velocity, which also becomes the target.
  void set(const BodyTwist& value);

  void advance();

  BodyTwist value() const { return {v_.value(), omega_.value()}; }
  /// The present rate of change, 1e-6 m/s^2 and 1e-6 rad/s^2.
  BodyTwist acceleration() const { return {v_.acceleration(), omega_.acceleration()}; }
  bool arrived() const { return v_.arrived() && omega_.arrived(); }

 private:
  /// One component, in 2^-12 of its unit; rates are per tick.
  class Axis {
   public:
    void set_target(std::int32_t target, std::int64_t acceleration, std::int64_t jerk);
    void take_target(const Axis& planned);
    void set(std::int32_t value);
    void advance();

    std::int32_t value() const { return static_cast<std::int32_t>(value_ >> kBits); }
    std::int32_t acceleration() const;
    std::int64_t gap() const { return target_ - value_; }
    std::int64_t gap_to(std::int32_t target) const { return (std::int64_t{target} << kBits) - value_; }
    bool arrived() const { return value_ == target_ && rate_ == 0; }
    bool steady() const { return rate_ == 0; }

   private:
    bool stops_within(std::int64_t rate, std::int64_t gap) const;
    std::int64_t next(std::int64_t rate, std::int64_t gap) const;

    std::int64_t value_ = 0, target_ = 0;
    std::int64_t rate_ = 0;
    std::int64_t most_ = 1, jerk_ = 1;
    std::int64_t far_ = 1;  // with a larger gap it is too early to slow down
  };
  static constexpr int kBits = 12;
  // However small the jerk limit is, the acceleration rises and falls within half a second each.
  static constexpr std::int64_t kSlowestRise_ticks = 500;

  void plan();
  static Limits per_tick(std::int32_t acceleration, std::int32_t jerk_milli);
  static void follow(Limits& follower, Limits& leader, std::int64_t way, std::int64_t leaders_way);

  Axis v_, omega_;
  Rates rates_;
  BodyTwist target_;
};

}  // namespace astro
