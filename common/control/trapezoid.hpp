#pragma once

#include <cstdint>

#include "common/control/segment.hpp"

namespace astro {

/// Trapezoidal speed profile of one segment, in whole ticks: up for `ramp` ticks, level for `level`, down for
/// `ramp`. Length and angle advance together, so an arc keeps its curvature. The steps are integers whose sum
/// is the segment exactly; no rounding is left at the end. Ticks are rounded up, so that no limit is
/// exceeded.
///
/// Units   travel 2^-50 m, turn 2^-52 turn (of a step and in total).
/// Cost    plan: two square roots and some divisions, for the start of a segment (main loop).
///         advance: constant, two multiplies; callable from the control tick.
class Trapezoid {
 public:
  struct Step {
    std::int64_t travel = 0;
    std::int64_t turn = 0;
  };

  Trapezoid() = default;  // an empty profile: done at once

  /// False if the segment is empty or moves and dwells, beyond kMaxLength / kMaxAngle, or would take longer
  /// than kMaxTicks.
  static bool plan(const Segment& segment, const MotionLimits& limits, Trapezoid& out);

  bool done() const { return tick_ >= 2 * ramp_ + level_; }
  /// The next tick's share of the segment. Not when done().
  Step advance();

  std::int64_t ticks() const { return 2 * ramp_ + level_; }

  /// Down to rest from now on, as steeply as it would have come down at the end. What is left of the segment
  /// then is rest().
  void cut_short();
  /// The part of the segment that no step has given yet.
  Segment rest() const;
  /// The part that was given, 2^-16 of the whole.
  std::uint32_t progress_16() const;

 private:
  std::int32_t ramp_ = 0, level_ = 0;
  std::int32_t tick_ = 0;
  std::int32_t dwell_ = 0;
  bool cut_ = false;
  // Fine enough that what the last step makes up is less than one share, for any segment and any valid
  // limits.
  static constexpr int kUnitBits = 17;
  Step unit_;   // what one of the profile's 2 ramp (ramp + level) equal shares is worth, kUnitBits finer
  Step rest_;   // kUnitBits finer: what the steps so far have rounded away
  Step total_;  // the whole segment
  Step given_;  // sum of the steps so far
};

}  // namespace astro
