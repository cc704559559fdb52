#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "common/protocol/enums.hpp"
#include "common/protocol/field.hpp"
#include "common/protocol/session.hpp"
#include "common/safety/fault.hpp"

/// The robot's state: status, faults, start.
namespace astro::protocol {

struct Status {
  std::uint64_t device_time_us = 0;
  Mode mode{};
  std::uint32_t latched_faults = 0;
  std::uint16_t queued_segments = 0;
  std::uint16_t running_tag = 0;
  std::int32_t battery_mv = 0;
  std::uint32_t tick_count = 0;
  std::uint32_t tick_overruns = 0;
  std::uint32_t tick_longest_us = 0;
  std::uint32_t rx_bad_frames = 0;
  ResetCause reset_cause{};
  std::uint16_t stops_by_others = 0;

  static constexpr std::uint8_t kId = 0x83;
  static constexpr std::string_view kName = "Status";
  static constexpr std::string_view kDoc = "The robot's state.";
  static constexpr std::tuple kFields{
      Field{&Status::device_time_us, "device_time_us", "us", "since power-on"},
      Field{&Status::mode, "mode", "", "what it is doing"},
      Field{&Status::latched_faults, "latched_faults", "bit mask", "bit n is Fault n"},
      Field{&Status::queued_segments, "queued_segments", "", "segments that wait, without the running one"},
      Field{&Status::running_tag, "running_tag", "", "tag of the running segment, 0 if none runs"},
      Field{&Status::battery_mv, "battery_mv", "mV", "motor supply, filtered"},
      Field{&Status::tick_count, "tick_count", "ticks", "control ticks since start, wraps"},
      Field{&Status::tick_overruns, "tick_overruns", "ticks", "ticks that did not come on time"},
      Field{&Status::tick_longest_us, "tick_longest_us", "us", "longest time between two ticks since start"},
      Field{&Status::rx_bad_frames, "rx_bad_frames", "frames", "damaged frames at all ports"},
      Field{&Status::reset_cause, "reset_cause", "", "why the processor last started"},
      Field{&Status::stops_by_others, "stops_by_others", "",
            "Stop, Disarm and EmergencyStop of hosts at other ports, without those of a driver that ends its "
            "own drive; wraps"},
  };
  bool operator==(const Status&) const = default;
};

struct GetStatus {
  using Reply = Status;
  static constexpr std::uint8_t kId = 0x03;
  static constexpr std::string_view kName = "GetStatus";
  static constexpr std::string_view kDoc = "Asks for the robot's state.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const GetStatus&) const = default;
};

struct FaultReport {
  std::uint32_t latched = 0;
  Fault first{};
  std::uint64_t first_time_us = 0;
  std::uint32_t raised_count = 0;

  static constexpr std::uint8_t kId = 0x92;
  static constexpr std::string_view kName = "FaultReport";
  static constexpr std::string_view kDoc = "The latched faults and the first one.";
  static constexpr std::tuple kFields{
      Field{&FaultReport::latched, "latched", "bit mask", "bit n is Fault n"},
      Field{&FaultReport::first, "first", "", "the first one since faults were last cleared"},
      Field{&FaultReport::first_time_us, "first_time_us", "us", "device time of the first one"},
      Field{&FaultReport::raised_count, "raised_count", "", "faults raised since start"},
  };
  bool operator==(const FaultReport&) const = default;
};

struct GetFaults {
  using Reply = FaultReport;
  static constexpr std::uint8_t kId = 0x12;
  static constexpr std::string_view kName = "GetFaults";
  static constexpr std::string_view kDoc = "Asks for the latched faults.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const GetFaults&) const = default;
};

struct ClearFaults {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x13;
  static constexpr std::string_view kName = "ClearFaults";
  static constexpr std::string_view kDoc = "Releases all latched faults; the robot stays disarmed.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const ClearFaults&) const = default;
};

struct FaultRaised {
  Fault fault{};
  std::uint64_t device_time_us = 0;

  static constexpr std::uint8_t kId = 0xC2;
  static constexpr std::string_view kName = "FaultRaised";
  static constexpr std::string_view kDoc = "A fault was latched.";
  static constexpr std::tuple kFields{
      Field{&FaultRaised::fault, "fault", "", "which"},
      Field{&FaultRaised::device_time_us, "device_time_us", "us", "when"},
  };
  bool operator==(const FaultRaised&) const = default;
};

struct Booted {
  ResetCause reset_cause{};

  static constexpr std::uint8_t kId = 0xC3;
  static constexpr std::string_view kName = "Booted";
  static constexpr std::string_view kDoc = "The firmware has started; earlier requests are forgotten.";
  static constexpr std::tuple kFields{
      Field{&Booted::reset_cause, "reset_cause", "", "why"},
  };
  bool operator==(const Booted&) const = default;
};

struct EventsMissed {
  std::uint16_t count = 0;

  static constexpr std::uint8_t kId = 0xC5;
  static constexpr std::string_view kName = "EventsMissed";
  static constexpr std::string_view kDoc =
      "Events before the next one were dropped because this port did not take them in time.";
  static constexpr std::tuple kFields{
      Field{&EventsMissed::count, "count", "",
            "how many since the last EventsMissed; 65535: that many or more"},
  };
  bool operator==(const EventsMissed&) const = default;
};

}  // namespace astro::protocol
