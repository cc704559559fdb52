#pragma once

#include <cstdint>

#include "firmware/app/tick/drive.hpp"

namespace astro::target {

/// A minute of driving from made-up counts: the same script on every processor, and a running check sum of
/// all that came out of it. Commands, counts and voltages are pseudo-random but such as a robot sees.
class Trace {
 public:
  static constexpr int kTicks = 60'000, kTicksPerSum = 1000;
  static constexpr int kSums = kTicks / kTicksPerSum;

  /// The same drive without a curvature effect, and with one.
  static constexpr int kScripts = 2;

  explicit Trace(int script) : drive_(parameters(script)) { drive_.arm(); }

  /// One tick; its pose, speeds and duty go into the sum.
  void advance(int tick) {
    if (tick % 700 == 0) command(tick / 700);
    move();
    TickInput input;
    input.now_us = static_cast<std::uint64_t>(tick) * 1000;
    input.counts = {left_, right_};
    input.battery_mv = 11'500 + static_cast<std::int32_t>(random() % 1000);
    drive_.host_seen();
    drive_.plan();
    const Drive::Output output = drive_.advance(input);
    if (!drive_.armed()) {
      drive_.clear_faults();
      drive_.arm();
    }
    note(output);
  }
  std::uint32_t sum() const { return sum_; }
  const Pose& pose() const { return drive_.pose(); }

 private:
  static ParameterSet parameters(int script) {
    ParameterSet set;
    if (script == 1) set.set(Param::e, 32'212'255);  // 0.03
    return set;
  }

  std::uint32_t random() {  // xorshift
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return state_;
  }

  void command(int number) {
    if (number % 3 == 0) {
      drive_.drive_velocity({static_cast<std::int32_t>(random() % 1'000'000) - 500'000,
                             static_cast<std::int32_t>(random() % 4'000'000) - 2'000'000});
      return;
    }
    Segment segment;
    segment.length_nm = static_cast<std::int64_t>(random() % 300'000'000) - 150'000'000;
    segment.angle_32 = number % 2 == 0 ? static_cast<std::int64_t>(random() >> 2) : 0;
    drive_.add_segment(segment, static_cast<std::uint16_t>(number));
  }

  /// Wheels that do what they are told, and now and then a little more.
  void move() {
    const WheelSpeeds wish = drive_.wheels().set_points();
    left_ += wish.left_umps / 80'692 + static_cast<std::int32_t>(random() % 3) - 1;
    right_ += wish.right_umps / 80'692 + static_cast<std::int32_t>(random() % 3) - 1;
  }

  void note(const Drive::Output& output) {
    const Pose& pose = drive_.pose();
    const WheelSpeeds& speeds = drive_.wheels().speeds();
    const std::uint64_t words[] = {static_cast<std::uint64_t>(pose.x),
                                   static_cast<std::uint64_t>(pose.y),
                                   pose.theta.raw(),
                                   static_cast<std::uint64_t>(pose.turns),
                                   static_cast<std::uint64_t>(speeds.left_umps),
                                   static_cast<std::uint64_t>(speeds.right_umps),
                                   static_cast<std::uint64_t>(output.duty.left),
                                   static_cast<std::uint64_t>(output.duty.right),
                                   static_cast<std::uint64_t>(output.bridge)};
    for (const std::uint64_t word : words)
      sum_ = (sum_ ^ static_cast<std::uint32_t>(word ^ word >> 32)) * 0x0100'0193;
  }

  Drive drive_;
  std::int32_t left_ = 0, right_ = 0;
  std::uint32_t state_ = 2463534242, sum_ = 2166136261;
};

}  // namespace astro::target
