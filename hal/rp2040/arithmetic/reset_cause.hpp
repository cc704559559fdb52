#pragma once

#include <cstdint>

#include "hal/interface/board.hpp"
#include "hal/rp2040/registers/registers.hpp"

namespace astro::rp2040 {

/// What the firmware leaves in the watchdog's first scratch register, which a restart by the watchdog does not change: the
/// watchdog does all restarts and cannot tell them apart.
namespace marker {
inline constexpr std::uint32_t kNone = 0;  // after power-on; nothing of ours has run
inline constexpr std::uint32_t kRunning = 0xA57B'0003;
inline constexpr std::uint32_t kReboot = 0xA57B'0001;
inline constexpr std::uint32_t kFault = 0xA57B'0002;
}  // namespace marker

/// Why the chip started, from WATCHDOG.REASON, CHIP_RESET and the marker. REASON is zero after any reset but the
/// watchdog's; CHIP_RESET keeps the cause before that. Without a marker the boot ROM has restarted the chip, because it has
/// received a program.
constexpr hal::ResetCause reset_cause(std::uint32_t reason, std::uint32_t chip_reset,
                                      std::uint32_t left_marker) {
  if ((reason & (watchdog::REASON_TIMER.mask() | watchdog::REASON_FORCE.mask())) != 0) {
    if (left_marker == marker::kFault) return hal::ResetCause::fault;
    if (left_marker == marker::kReboot || left_marker == marker::kNone) return hal::ResetCause::software;
    return watchdog::REASON_TIMER.of(reason) != 0 ? hal::ResetCause::watchdog : hal::ResetCause::unknown;
  }
  if (chip_reset::CHIP_RESET_HAD_RUN.of(chip_reset) != 0) return hal::ResetCause::pin;
  if (chip_reset::CHIP_RESET_HAD_POR.of(chip_reset) != 0) return hal::ResetCause::power_on;
  return hal::ResetCause::unknown;
}

}  // namespace astro::rp2040
