#pragma once

#include <cstdint>

namespace astro {

/// Wheel speed from encoder counts: a tracking loop (type-2 phase-locked loop). Its state is an estimated
/// position and speed, which each count corrects. The speed is smooth where a difference of counts would
/// toggle between 0 and 1, and has no lag at constant speed. The commanded acceleration is a feed-forward:
/// with it there is no lag behind a ramp either, because the loop only has to follow what the wheel does
/// differently.
///
/// Units   speed in 2^-20 counts per tick
/// Cost    constant, three multiplies; callable from the control tick
/// Source  critically damped: kp = 2 w T - (w T)^2 and ki = (w T)^2 put both poles at 1 - w T, for bandwidth
///         w and tick T
class SpeedObserver {
 public:
  static constexpr int kSpeedBits = 20;

  /// Made from a bandwidth in 2^-16 rad/s. It takes a division, so it is computed outside the tick.
  struct Gains {
    Gains() = default;
    explicit Gains(std::int32_t bandwidth_16);
    std::int32_t proportional_20 = 0, integral_20 = 0;
  };

  /// Keeps the present estimate, so the bandwidth may change while driving.
  void set_gains(const Gains& gains) { gains_ = gains; }

  /// `counts`: signed counts since the last tick, forward positive. `expected`: the speed change that was
  /// commanded meanwhile, in 2^-20 counts per tick; limited to a quarter of a count.
  void advance(std::int32_t counts, std::int32_t expected = 0);

  std::int32_t speed() const { return static_cast<std::int32_t>(speed_40_ >> 20); }
  void reset() {
    error_20_ = 0;
    speed_40_ = 0;
  }

 private:
  static constexpr int kCountBits = 11;  // +-1024 counts a tick: far beyond any encoder
  static constexpr int kExpectedBits = kSpeedBits - 1;
  static constexpr std::int32_t kMost_8 = 1 << (kCountBits - 1 + 8);

  Gains gains_;
  std::int32_t error_20_ = 0;  // position counted minus position estimated
  std::int64_t speed_40_ = 0;  // fine enough to hold products of the error and ki, which is about 0.01
};

}  // namespace astro
