#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "common/protocol/field.hpp"

/// The faults that the robot keeps through restarts.
namespace astro::protocol {

/// Fault and mode are plain numbers here: they come from flash, and newer firmware may have stored numbers
/// that this version has no name for.
struct FaultLogEntry {
  std::uint32_t number = 0;
  std::uint32_t start = 0;
  std::uint64_t device_time_us = 0;
  std::uint8_t fault = 0;
  std::uint8_t mode = 0;
  std::int32_t battery_mv = 0;
  std::int32_t left_umps = 0;
  std::int32_t right_umps = 0;
  std::uint16_t missed = 0;

  static constexpr std::uint8_t kId = 0x99;
  static constexpr std::string_view kName = "FaultLogEntry";
  static constexpr std::string_view kDoc =
      "A fault of this start or an earlier one, and what the robot was doing.";
  static constexpr std::tuple kFields{
      Field{&FaultLogEntry::number, "number", "",
            "one more than the previous entry's, across all starts; wraps"},
      Field{&FaultLogEntry::start, "start", "", "counts the starts that logged a fault, from 1 on; wraps"},
      Field{&FaultLogEntry::device_time_us, "device_time_us", "us", "when, since that start"},
      Field{&FaultLogEntry::fault, "fault", "", "number of a Fault, perhaps one of newer firmware"},
      Field{&FaultLogEntry::mode, "mode", "", "number of the Mode it came in, perhaps one of newer firmware"},
      Field{&FaultLogEntry::battery_mv, "battery_mv", "mV", "motor supply, filtered"},
      Field{&FaultLogEntry::left_umps, "left_umps", "1e-6 m/s", "observed, left wheel's rim"},
      Field{&FaultLogEntry::right_umps, "right_umps", "1e-6 m/s", "observed, right wheel's rim"},
      Field{&FaultLogEntry::missed, "missed", "",
            "faults before this one that were not logged because too many came at once"},
  };
  bool operator==(const FaultLogEntry&) const = default;
};

struct GetFaultLog {
  std::uint16_t index = 0;

  using Reply = FaultLogEntry;
  static constexpr std::uint8_t kId = 0x19;
  static constexpr std::string_view kName = "GetFaultLog";
  static constexpr std::string_view kDoc =
      "Asks for one entry of the fault log; out_of_range if there is none. A fault is logged once the robot "
      "has stopped.";
  static constexpr std::tuple kFields{
      Field{&GetFaultLog::index, "index", "", "0 is the newest"},
  };
  bool operator==(const GetFaultLog&) const = default;
};

}  // namespace astro::protocol
