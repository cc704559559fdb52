#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "common/protocol/enums.hpp"
#include "common/protocol/field.hpp"
#include "common/protocol/session.hpp"

/// Making the robot move, and stop. Forward and counter-clockwise are positive.
namespace astro::protocol {

struct Arm {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x04;
  static constexpr std::string_view kName = "Arm";
  static constexpr std::string_view kDoc =
      "Lets the sender drive the robot; refused while a fault is latched or another host drives.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const Arm&) const = default;
};

struct Disarm {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x05;
  static constexpr std::string_view kName = "Disarm";
  static constexpr std::string_view kDoc = "Opens the bridges at once and empties the queue.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const Disarm&) const = default;
};

struct Stop {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x06;
  static constexpr std::string_view kName = "Stop";
  static constexpr std::string_view kDoc =
      "Ramps to rest and empties the queue. The robot stays armed, but moves for nobody until an Arm.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const Stop&) const = default;
};

struct Rest {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x1B;
  static constexpr std::string_view kName = "Rest";
  static constexpr std::string_view kDoc =
      "Ramps to rest and empties the queue; the sender, who must be driving, may go on without an Arm.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const Rest&) const = default;
};

struct EmergencyStop {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x07;
  static constexpr std::string_view kName = "EmergencyStop";
  static constexpr std::string_view kDoc = "Latches the fault emergency_stop: zero duty at once.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const EmergencyStop&) const = default;
};

struct Velocity {
  std::int32_t v_umps = 0;
  std::int32_t omega_uradps = 0;

  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x08;
  static constexpr std::string_view kName = "Velocity";
  static constexpr std::string_view kDoc =
      "Drives at this velocity until the next motion request or the command timeout.";
  static constexpr std::tuple kFields{
      Field{&Velocity::v_umps, "v_umps", "1e-6 m/s", "of the robot centre, forward positive"},
      Field{&Velocity::omega_uradps, "omega_uradps", "1e-6 rad/s", "counter-clockwise positive"},
  };
  bool operator==(const Velocity&) const = default;
};

struct WheelVoltage {
  std::int32_t left_mv = 0;
  std::int32_t right_mv = 0;

  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x16;
  static constexpr std::string_view kName = "WheelVoltage";
  static constexpr std::string_view kDoc =
      "Puts voltages on the motors in open loop, until the next motion request or the command timeout.";
  static constexpr std::tuple kFields{
      Field{&WheelVoltage::left_mv, "left_mv", "mV", "left motor, forward positive; limited by the supply"},
      Field{&WheelVoltage::right_mv, "right_mv", "mV",
            "right motor, forward positive; limited by the supply"},
  };
  bool operator==(const WheelVoltage&) const = default;
};

struct AddSegment {
  SegmentKind kind{};
  std::uint16_t tag = 0;
  std::int64_t length_nm = 0;
  std::int64_t angle = 0;
  std::int32_t speed_umps = 0;
  std::int32_t yaw_rate_uradps = 0;
  std::uint32_t dwell_ms = 0;

  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x09;
  static constexpr std::string_view kName = "AddSegment";
  static constexpr std::string_view kDoc =
      "Appends a motion from rest to rest to the queue; SegmentDone reports its end under the same tag.";
  static constexpr std::tuple kFields{
      Field{&AddSegment::kind, "kind", "", "shape"},
      Field{&AddSegment::tag, "tag", "", "the host's own number for it"},
      Field{&AddSegment::length_nm, "length_nm", "1e-9 m",
            "signed path length of the robot centre; 0 for a spin or a stop"},
      Field{&AddSegment::angle, "angle", "2^-32 turn", "signed change of heading; 0 for a line or a stop"},
      Field{&AddSegment::speed_umps, "speed_umps", "1e-6 m/s", "greatest speed; 0: the robot's limit"},
      Field{&AddSegment::yaw_rate_uradps, "yaw_rate_uradps", "1e-6 rad/s",
            "greatest yaw rate; 0: the robot's limit"},
      Field{&AddSegment::dwell_ms, "dwell_ms", "ms", "time to wait, for a stop; 0 for all others"},
  };
  bool operator==(const AddSegment&) const = default;
};

struct Pause {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x17;
  static constexpr std::string_view kName = "Pause";
  static constexpr std::string_view kDoc =
      "Ramps to rest: on a path, where its rest waits for Resume. Until then no velocity moves the robot.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const Pause&) const = default;
};

struct Resume {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x18;
  static constexpr std::string_view kName = "Resume";
  static constexpr std::string_view kDoc =
      "Ends a Pause and continues the path; refused to the driver if somebody else has paused.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const Resume&) const = default;
};

struct SetPose {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::uint64_t theta = 0;

  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x0A;
  static constexpr std::string_view kName = "SetPose";
  static constexpr std::string_view kDoc =
      "The odometry continues from this pose of the base in the odom frame.";
  static constexpr std::tuple kFields{
      Field{&SetPose::x, "x", "2^-40 m", ""},
      Field{&SetPose::y, "y", "2^-40 m", ""},
      Field{&SetPose::theta, "theta", "2^-64 turn", "heading; the count of whole turns becomes 0"},
  };
  bool operator==(const SetPose&) const = default;
};

struct SegmentDone {
  std::uint16_t tag = 0;
  SegmentOutcome outcome{};
  std::uint64_t device_time_us = 0;

  static constexpr std::uint8_t kId = 0xC1;
  static constexpr std::string_view kName = "SegmentDone";
  static constexpr std::string_view kDoc = "A segment has left the queue.";
  static constexpr std::tuple kFields{
      Field{&SegmentDone::tag, "tag", "", "as in AddSegment"},
      Field{&SegmentDone::outcome, "outcome", "", "how it ended"},
      Field{&SegmentDone::device_time_us, "device_time_us", "us", "when"},
  };
  bool operator==(const SegmentDone&) const = default;
};

struct SegmentStarted {
  std::uint16_t tag = 0;
  std::uint64_t device_time_us = 0;

  static constexpr std::uint8_t kId = 0xC4;
  static constexpr std::string_view kName = "SegmentStarted";
  static constexpr std::string_view kDoc = "A segment has begun, or continues after a Pause.";
  static constexpr std::tuple kFields{
      Field{&SegmentStarted::tag, "tag", "", "as in AddSegment"},
      Field{&SegmentStarted::device_time_us, "device_time_us", "us", "when"},
  };
  bool operator==(const SegmentStarted&) const = default;
};

}  // namespace astro::protocol
