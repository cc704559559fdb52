#pragma once

#include <cstdint>

#include "common/control/segment.hpp"

namespace astro {

/// Trapezoidal speed profile of one segment, in whole ticks: the speed goes up for `ramp` ticks, stays level
/// for `level` ticks, and goes down for `ramp` ticks. Length and angle advance together, so an arc keeps its
/// curvature. The steps are integers whose sum is exactly the segment. The numbers of ticks are rounded up,
/// so no limit is exceeded.
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

  /// False if the segment is empty or moves and dwells, beyond kMaxLength_nm or kMaxAngle_32, or would take longer
  /// than kMaxTicks.
  static bool plan(const Segment& segment, const MotionLimits& limits, Trapezoid& out);

  bool done() const { return tick_ >= 2 * ramp_ + level_; }
  /// The next tick's share of the segment. Not when done().
  Step advance();

  std::int64_t ticks() const { return 2 * ramp_ + level_; }
  /// Sum of the steps so far.
  const Step& given() const { return given_; }
  /// It was cut short, so that a part of the segment is left when it is done.
  bool was_cut() const { return cut_; }

  /// Goes down to rest from now on, as steeply as at the planned end. The part of the segment that is then
  /// left is rest().
  void cut_short();
  /// The part of the segment that the steps so far have not covered.
  Segment rest() const;
  /// The part that they have covered, in 2^-16 of the whole.
  std::uint32_t progress_16() const;

 private:
  std::int32_t ramp_ = 0, level_ = 0;
  std::int32_t tick_ = 0;
  std::int32_t dwell_ = 0;
  bool cut_ = false;
  // Fine enough that the correction in the last step is less than one share, for any segment and valid
  // limits.
  static constexpr int kUnitBits = 17;
  Step unit_;   // one of the profile's 2 ramp (ramp + level) equal shares, kUnitBits finer
  Step rest_;   // what the steps so far have rounded away, kUnitBits finer
  Step total_;  // the whole segment
  Step given_;  // sum of the steps so far
};

}  // namespace astro
