#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/safety/fault.hpp"

namespace astro {

/// What the robot was doing when a fault came.
struct FaultCircumstances {
  std::uint64_t time_us = 0;  // since that start
  std::int32_t battery_mv = 0;
  std::int32_t left_umps = 0, right_umps = 0;  // observed, at the wheels' rims
  std::uint16_t missed = 0;                    // faults before this one that were not logged
  Fault fault = Fault::none;                   // may be a fault of newer firmware, without a name here
  std::uint8_t mode = 0;                       // number of a protocol::Mode

  bool operator==(const FaultCircumstances&) const = default;
};

/// An entry of the fault log.
struct LoggedFault {
  std::uint32_t number = 0;  // one more than the previous entry's, across all starts; wraps
  std::uint32_t start = 0;   // counts the starts that logged a fault, from 1 on; wraps
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
/// Returns nothing if the bytes are not a whole, undamaged entry.
std::optional<LoggedFault> decode(const FaultRecord& record);

}  // namespace astro
