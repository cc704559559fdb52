#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/safety/fault.hpp"

namespace astro {

/// What was going on when a fault came.
struct FaultCircumstances {
  std::uint64_t time_us = 0;  // since that start
  std::int32_t battery_mv = 0;
  std::int32_t left_umps = 0, right_umps = 0;  // observed, at the wheels' rims
  std::uint16_t missed = 0;                    // faults before it that were not logged
  Fault fault = Fault::none;                   // newer firmware may have left one without a name
  std::uint8_t mode = 0;                       // number of a protocol::Mode: what the robot was doing

  bool operator==(const FaultCircumstances&) const = default;
};

/// An entry of the fault log.
struct LoggedFault {
  std::uint32_t number = 0;  // one more than the entry before, through all starts; wraps
  std::uint32_t start = 0;   // starts of the robot that logged a fault, counted from 1; wraps
  FaultCircumstances was;

  bool operator==(const LoggedFault&) const = default;
};

/// One entry as it lies in flash. All numbers little-endian:
///
///   0   4   "ASF" and the format version, 1
///   4   1   fault
///   5   1   mode
///   6   2   missed
///   8   4   number
///   12  4   start
///   16  8   time, us
///   24  4   battery, mV
///   28  8   left and right wheel, um/s
///   36  4   CRC-32 of everything before it
inline constexpr std::size_t kFaultRecordBytes = 40;
using FaultRecord = std::array<std::uint8_t, kFaultRecordBytes>;

FaultRecord encode(const LoggedFault& entry);
/// Nothing if the bytes are not one whole entry, undamaged.
std::optional<LoggedFault> decode(const FaultRecord& record);

}  // namespace astro
