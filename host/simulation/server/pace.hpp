#pragma once

#include <chrono>

namespace astro::simulation {

/// Keeps virtual time, which passes in steps of a millisecond, beside real time. The caller reads the clock.
///
/// A server that was held up, because others need the processor, makes up for it: each step that was missed
/// is made, at no more than twice real time, so that a host has time to speak before the robot's own
/// time-outs run out. After a pause of more than 2 s (a computer that slept) it begins anew instead.
class Pace {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Duration = std::chrono::steady_clock::duration;
  static constexpr Duration kStep = std::chrono::milliseconds(1);

  explicit Pace(Time now) { restart(now); }

  /// True if a step is due. To be asked before each; a step that is made is to be told by stepped().
  bool due(Time now);
  /// True if a host that has just spoken may be answered by a step that is due only in a moment.
  bool may_hurry(Time now) const { return due_ - now <= kStep; }
  /// Each step counts, also one that was made early: it is not made a second time.
  void stepped();
  /// When to ask again.
  Time next() const { return next_; }
  /// The next step is due at `now`, whatever was before.
  void restart(Time now);

 private:
  Time due_, asked_, next_;
  Duration credit_{};  // real time that steps may take back now
};

}  // namespace astro::simulation
