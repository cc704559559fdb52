#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "common/protocol/enums.hpp"
#include "common/protocol/field.hpp"
#include "common/protocol/session.hpp"

/// The stream of measurements. The host chooses groups by a bit mask; a Telemetry carries the chosen groups
/// in bit order, all from the same tick.
namespace astro::protocol {

struct PoseGroup {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::uint64_t theta = 0;
  std::int32_t turns = 0;
  static constexpr std::tuple kFields{
      Field{&PoseGroup::x, "x", "2^-40 m", "base in the odom frame"},
      Field{&PoseGroup::y, "y", "2^-40 m", "base in the odom frame"},
      Field{&PoseGroup::theta, "theta", "2^-64 turn", "heading"},
      Field{&PoseGroup::turns, "turns", "turns",
            "whole turns; with theta they are the heading without wraps"},
  };
  bool operator==(const PoseGroup&) const = default;
};

struct CountsGroup {
  std::int32_t left = 0;
  std::int32_t right = 0;
  static constexpr std::tuple kFields{
      Field{&CountsGroup::left, "left", "counts", "forward positive, wraps at 2^32"},
      Field{&CountsGroup::right, "right", "counts", "forward positive, wraps at 2^32"},
  };
  bool operator==(const CountsGroup&) const = default;
};

struct TwistGroup {
  std::int32_t v_umps = 0;
  std::int32_t omega_uradps = 0;
  static constexpr std::tuple kFields{
      Field{&TwistGroup::v_umps, "v_umps", "1e-6 m/s", "observed, of the robot centre"},
      Field{&TwistGroup::omega_uradps, "omega_uradps", "1e-6 rad/s", "observed, counter-clockwise positive"},
  };
  bool operator==(const TwistGroup&) const = default;
};

struct WheelGroup {
  std::int32_t left_umps = 0;
  std::int32_t right_umps = 0;
  static constexpr std::tuple kFields{
      Field{&WheelGroup::left_umps, "left_umps", "1e-6 m/s", "at the left wheel's rim, forward positive"},
      Field{&WheelGroup::right_umps, "right_umps", "1e-6 m/s", "at the right wheel's rim, forward positive"},
  };
  bool operator==(const WheelGroup&) const = default;
};

struct DutyGroup {
  std::int16_t left = 0;
  std::int16_t right = 0;
  static constexpr std::tuple kFields{
      Field{&DutyGroup::left, "left", "2^-15", "fraction of the bus voltage, forward positive"},
      Field{&DutyGroup::right, "right", "2^-15", "fraction of the bus voltage, forward positive"},
  };
  bool operator==(const DutyGroup&) const = default;
};

struct BatteryGroup {
  std::int32_t mv = 0;
  static constexpr std::tuple kFields{Field{&BatteryGroup::mv, "mv", "mV", "motor supply, filtered"}};
  bool operator==(const BatteryGroup&) const = default;
};

struct StateGroup {
  Mode mode{};
  std::uint16_t tag = 0;
  std::uint32_t latched_faults = 0;
  static constexpr std::tuple kFields{
      Field{&StateGroup::mode, "mode", "", "what the robot is doing"},
      Field{&StateGroup::tag, "tag", "", "of the running segment, 0 if none runs"},
      Field{&StateGroup::latched_faults, "latched_faults", "bit mask", "bit n is Fault n"},
  };
  bool operator==(const StateGroup&) const = default;
};

struct PathGroup {
  std::uint16_t tag = 0;
  std::uint16_t progress = 0;
  std::uint16_t queued = 0;
  std::int32_t cross_track_um = 0;
  std::int32_t heading_error_urad = 0;
  static constexpr std::tuple kFields{
      Field{&PathGroup::tag, "tag", "", "of the running segment, 0 if none runs"},
      Field{&PathGroup::progress, "progress", "2^-15", "part of the segment that has been driven"},
      Field{&PathGroup::queued, "queued", "", "segments that wait"},
      Field{&PathGroup::cross_track_um, "cross_track_um", "1e-6 m",
            "distance of the path to the robot's left"},
      Field{&PathGroup::heading_error_urad, "heading_error_urad", "1e-6 rad",
            "the path's heading minus the robot's"},
  };
  bool operator==(const PathGroup&) const = default;
};

struct FusedGroup {
  std::uint64_t time_us = 0;
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::uint64_t theta = 0;
  std::int32_t turns = 0;
  std::int32_t rate_uradps = 0;
  std::int32_t bias_uradps = 0;
  std::int16_t temperature_cC = INT16_MIN;
  GyroState gyro{};
  std::uint16_t slips = 0;
  static constexpr std::tuple kFields{
      Field{&FusedGroup::time_us, "time_us", "us", "device time of this pose, at most 10 ms ago"},
      Field{&FusedGroup::x, "x", "2^-40 m", "base in the odom frame, by wheels and gyro"},
      Field{&FusedGroup::y, "y", "2^-40 m", "base in the odom frame, by wheels and gyro"},
      Field{&FusedGroup::theta, "theta", "2^-64 turn", "heading by wheels and gyro"},
      Field{&FusedGroup::turns, "turns", "turns",
            "whole turns; with theta they are the heading without wraps"},
      Field{&FusedGroup::rate_uradps, "rate_uradps", "1e-6 rad/s",
            "mean yaw rate by the gyro over 10 ms, without its bias"},
      Field{&FusedGroup::bias_uradps, "bias_uradps", "1e-6 rad/s", "the gyro's bias"},
      Field{&FusedGroup::temperature_cC, "temperature_cC", "0.01 degC",
            "of the gyro; -32768: it does not say"},
      Field{&FusedGroup::gyro, "gyro", "", "whether the gyro counts, or why it does not"},
      Field{&FusedGroup::slips, "slips", "", "turns that no wheel saw, since start; wraps"},
  };
  bool operator==(const FusedGroup&) const = default;
};

struct Telemetry {
  static constexpr std::uint32_t kPose = 1U << 0;
  static constexpr std::uint32_t kCounts = 1U << 1;
  static constexpr std::uint32_t kTwist = 1U << 2;
  static constexpr std::uint32_t kWheelSpeed = 1U << 3;
  static constexpr std::uint32_t kSetpoint = 1U << 4;
  static constexpr std::uint32_t kDuty = 1U << 5;
  static constexpr std::uint32_t kBattery = 1U << 6;
  static constexpr std::uint32_t kState = 1U << 7;
  static constexpr std::uint32_t kPath = 1U << 8;
  static constexpr std::uint32_t kFused = 1U << 9;
  static constexpr std::uint32_t kAll = 0x3FF;

  std::uint64_t device_time_us = 0;
  std::uint32_t fields = 0;
  PoseGroup pose{};
  CountsGroup counts{};
  TwistGroup twist{};
  WheelGroup wheel_speed{};
  WheelGroup setpoint{};
  DutyGroup duty{};
  BatteryGroup battery{};
  StateGroup state{};
  PathGroup path{};
  FusedGroup fused{};

  static constexpr std::uint8_t kId = 0xC0;
  static constexpr std::string_view kName = "Telemetry";
  static constexpr std::string_view kDoc =
      "One sample. Groups whose bit is not set in `fields` are not on the wire.";
  static constexpr std::tuple kFields{
      Field{&Telemetry::device_time_us, "device_time_us", "us", "time of the tick that all groups belong to"},
      Field{&Telemetry::fields, "fields", "bit mask", "which groups follow"},
      Group{&Telemetry::pose, 0, "pose", "odometry"},
      Group{&Telemetry::counts, 1, "counts", "encoder counts since start"},
      Group{&Telemetry::twist, 2, "twist", "velocity of the base"},
      Group{&Telemetry::wheel_speed, 3, "wheel_speed", "observed wheel speeds"},
      Group{&Telemetry::setpoint, 4, "setpoint", "commanded wheel speeds"},
      Group{&Telemetry::duty, 5, "duty", "commanded duty"},
      Group{&Telemetry::battery, 6, "battery", "supply"},
      Group{&Telemetry::state, 7, "state", "mode, segment and faults"},
      Group{&Telemetry::path, 8, "path", "how the path is followed"},
      Group{&Telemetry::fused, 9, "fused", "the pose by wheels and gyro; the odometry's without a gyro"},
  };
  bool operator==(const Telemetry&) const = default;
};

struct SlipFound {
  std::uint64_t device_time_us = 0;
  std::int16_t turn_100urad = 0;

  static constexpr std::uint8_t kId = 0xC6;
  static constexpr std::string_view kName = "SlipFound";
  static constexpr std::string_view kDoc =
      "The gyro has noticed that the robot turned without its wheels: a kick, or a wheel that slipped.";
  static constexpr std::tuple kFields{
      Field{&SlipFound::device_time_us, "device_time_us", "us", "when"},
      Field{&SlipFound::turn_100urad, "turn_100urad", "1e-4 rad",
            "how far until then, counter-clockwise positive; it may go on"},
  };
  bool operator==(const SlipFound&) const = default;
};

struct SetTelemetry {
  std::uint16_t period_ms = 0;
  std::uint32_t fields = 0;

  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x11;
  static constexpr std::string_view kName = "SetTelemetry";
  static constexpr std::string_view kDoc =
      "Chooses the groups of Telemetry for this port and how often it comes.";
  static constexpr std::tuple kFields{
      Field{&SetTelemetry::period_ms, "period_ms", "ms", "0: off"},
      Field{&SetTelemetry::fields, "fields", "bit mask", "as in Telemetry"},
  };
  bool operator==(const SetTelemetry&) const = default;
};

}  // namespace astro::protocol
