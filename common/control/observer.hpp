#pragma once

#include <cstdint>

namespace astro {

/// Wheel speed from encoder counts: a tracking loop (type-2 phase-locked loop) whose state is an estimated
/// position and speed, corrected by the count that the encoder shows. Smooth where a difference of counts
/// would toggle between 0 and 1, and without lag at constant speed. Told of the acceleration that is wanted
/// of the wheel, it does not lag behind that either: the loop has to find only what the wheel does otherwise.
///
/// Units   speed in 2^-20 counts per tick.
/// Cost    constant, three multiplies; callable from the control tick.
/// Source  critically damped: kp = 2 w T - (w T)^2, ki = (w T)^2 put both poles at 1 - w T, for bandwidth w
/// and tick T.
class SpeedObserver {
 public:
  static constexpr int kSpeedBits = 20;

  /// Of a bandwidth in 2^-16 rad/s. Takes a division: made outside the tick.
  struct Gains {
    Gains() = default;
    explicit Gains(std::int32_t bandwidth_16);
    std::int32_t proportional_20 = 0, integral_20 = 0;
  };

  /// The estimate so far is kept, so the parameter may change while driving.
  void set_gains(const Gains& gains) { gains_ = gains; }
  void set_bandwidth(std::int32_t bandwidth_16) { gains_ = Gains(bandwidth_16); }

  /// `counts`: signed counts since the last tick, forward positive. `expected`: by how much the speed should
  /// have changed meanwhile, 2^-20 counts per tick; more than a quarter of a count counts as that.
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
  std::int32_t error_20_ = 0;  // position seen minus position estimated
  std::int64_t speed_40_ = 0;  // whole products of error and ki, which is about 0.01
};

}  // namespace astro
