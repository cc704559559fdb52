#pragma once

#include <cmath>

/// A slip at restart: after a spin the tyres are twisted under the standing robot, and when it starts again after a second or
/// more they let go. The heading jumps, in the sense of the spin, and the wheels do not notice.
///
/// A motion ends when the wheels have stopped for 20 ms. It is a spin if the robot's centre has moved by less than a
/// quarter of what each wheel has travelled; what moved no wheel by 5 mm, such as a correction at the end of a segment, is no
/// motion and changes nothing.
namespace astro::sim {

class RestartSlip {
 public:
  explicit RestartSlip(double slip_rad) : slip_rad_(slip_rad) {}

  /// How far the heading jumps in this tick, rad, counter-clockwise. One call a tick, with the travel of both wheels.
  double advance(double left_m, double right_m) {
    if (slip_rad_ == 0.0) return 0.0;
    if (std::abs(left_m) < kStopped_m && std::abs(right_m) < kStopped_m) {
      if (++stopped_ticks_ == kEnd_ticks) end_motion();
      return 0.0;
    }
    const double jump_rad = stopped_ticks_ >= kStand_ticks ? sense_ * slip_rad_ : 0.0;
    if (jump_rad != 0.0) sense_ = 0.0;
    stopped_ticks_ = 0;
    along_m_ += 0.5 * (left_m + right_m);
    around_m_ += 0.5 * (right_m - left_m);
    return jump_rad;
  }

 private:
  static constexpr double kStopped_m = 1e-6;  // in a tick: 1 mm/s
  static constexpr double kMotion_m = 0.005;
  static constexpr int kEnd_ticks = 20, kStand_ticks = 1000;

  void end_motion() {
    const double along_m = std::abs(along_m_), around_m = std::abs(around_m_);
    if (along_m + around_m >= kMotion_m)
      sense_ = along_m < around_m / 4 ? std::copysign(1.0, around_m_) : 0.0;
    along_m_ = around_m_ = 0.0;
  }

  double slip_rad_;
  double along_m_ = 0.0, around_m_ = 0.0;  // of the present motion
  double sense_ = 0.0;  // of the last motion: +1 or -1 if it was a spin, which has not been let go
  int stopped_ticks_ = 0;
};

}  // namespace astro::sim
