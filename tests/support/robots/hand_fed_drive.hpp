#pragma once

#include <cstdint>
#include <optional>

#include "firmware/app/tick/drive.hpp"

/// The control tick without a world: a test sets the encoders' counts and the supply. For thresholds, which a
/// simulated robot would not hit exactly.
namespace astro::support {

class HandFedDrive {
 public:
  explicit HandFedDrive(const ParameterSet& set = {}, const hal::EncoderCounts& start = {})
      : counts_(start), drive_(set) {}

  // The input of every tick until it is changed.
  std::int32_t battery_mv = 12'000;
  bool on_time = true;
  std::optional<BodyTwist> velocity;      // the host repeats it
  std::optional<WheelVoltages> voltages;  // or these

  /// One tick in which the wheels turn by so many counts; the host is alive.
  Drive::Output tick(std::int32_t left = 0, std::int32_t right = 0) {
    counts_ = {sum(counts_.left, left), sum(counts_.right, right)};
    now_us_ += 1000;
    drive_.host_seen();
    if (velocity) drive_.drive_velocity(*velocity);
    if (voltages) drive_.drive_wheels(*voltages);
    output_ = drive_.advance({now_us_, counts_, battery_mv, false, on_time});
    drive_.plan();
    return output_;
  }
  void ticks(int count, std::int32_t left = 0, std::int32_t right = 0) {
    for (int i = 0; i < count; ++i) tick(left, right);
  }
  /// Arms the robot after boot, at rest.
  void arm() {
    ticks(50);
    drive_.arm();
    tick();
  }

  Drive& drive() { return drive_; }
  const Drive::Output& output() const { return output_; }
  bool has(Fault fault) const { return (drive_.faults().mask() & bit(fault)) != 0; }
  std::uint64_t now_us() const { return now_us_; }

 private:
  static std::int32_t sum(std::int32_t a, std::int32_t b) {  // wraps, as decoders do
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
  }

  hal::EncoderCounts counts_;
  Drive drive_;
  Drive::Output output_;
  std::uint64_t now_us_ = 0;
};

/// Encoders so fine that one count a tick is 78.8 um/s: slow speeds are then whole counts in every tick, and
/// the measured speed does not ripple.
inline ParameterSet fine_encoders() {
  ParameterSet set;
  set.set(Param::counts_per_motor_rev, 65'536);
  return set;
}
inline constexpr double kFineCount_umps = 78.8;  // pi * 72 mm / (65536 * 43.8) in a millisecond

/// A robot that does not react to the counts that a test feeds it: all feedback gains are 0.
inline ParameterSet without_feedback(ParameterSet set = {}) {
  for (const Param gain :
       {Param::kp, Param::ki, Param::k_sync, Param::path_k_along, Param::path_k_cross, Param::path_k_heading})
    set.set(gain, 0);
  return set;
}

}  // namespace astro::support
