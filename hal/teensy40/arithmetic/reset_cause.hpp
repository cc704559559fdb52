#pragma once

#include <cstdint>

#include "hal/interface/board.hpp"
#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40 {

/// The firmware writes one of these to SRC_GPR5, which a warm reset does not change, before it restarts the
/// chip: the reset controller cannot distinguish an intended restart, a fault's restart and a lock-up of the
/// core.
namespace marker {
inline constexpr std::uint32_t kNone = 0;
inline constexpr std::uint32_t kReboot = 0xA57B'0001;
inline constexpr std::uint32_t kFault = 0xA57B'0002;
}  // namespace marker

/// Why the chip started, from SRC_SRSR and the marker. The bits are sticky: clear them after reading, or the
/// next start sees them, too.
constexpr hal::ResetCause reset_cause(std::uint32_t srsr, std::uint32_t left_marker) {
  if (src::SRSR_IPP_RESET_B.of(srsr) != 0) return hal::ResetCause::power_on;  // no marker outlives that
  if (src::SRSR_WDOG3_RST_B.of(srsr) != 0 || src::SRSR_WDOG_RST_B.of(srsr) != 0)
    return hal::ResetCause::watchdog;
  if (src::SRSR_LOCKUP_SYSRESETREQ.of(srsr) != 0)  // without a marker of ours the core locked up
    return left_marker == marker::kReboot ? hal::ResetCause::software : hal::ResetCause::fault;
  if (src::SRSR_IPP_USER_RESET_B.of(srsr) != 0) return hal::ResetCause::pin;
  return hal::ResetCause::unknown;
}

}  // namespace astro::teensy40
