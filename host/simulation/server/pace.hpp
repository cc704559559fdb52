#pragma once

#include <chrono>

namespace astro::simulation {

/// Keeps virtual time, which passes in steps of a millisecond, equal to real time. The caller reads the
/// clock.
///
/// A server that was delayed, because other programs needed the processor, catches up: it makes each missed
/// step, at no more than twice real time, so that a host can send something before the robot's time-outs
/// expire. After a pause of more than 2 s (the computer slept) it starts again from the present time instead.
class Pace {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Duration = std::chrono::steady_clock::duration;
  static constexpr Duration kStep = std::chrono::milliseconds(1);

  explicit Pace(Time now) { restart(now); }

  /// True if a step is due. Must be called before each step, and stepped() after it.
  bool due(Time now);
  /// True if the next step may be made now, up to one step early, to answer a host that has just sent
  /// something.
  bool may_step_early(Time now) const { return due_ - now <= kStep; }
  /// A step was made. An early one counts, too: it is not made a second time.
  void stepped();
  /// When to ask again.
  Time next() const { return next_; }
  /// Forgets the past: the next step is due at `now`.
  void restart(Time now);

 private:
  Time due_, asked_, next_;
  Duration credit_{};  // real time that may be caught up now
};

}  // namespace astro::simulation
