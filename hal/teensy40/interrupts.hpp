#pragma once

#include <cstdint>

namespace astro::teensy40 {

namespace irq {
inline constexpr int kLpuart6 = 25, kPit = 122;
}

/// Urgency, smaller is more; the chip knows 16 levels. Faults have 0 for themselves.
namespace urgency {
inline constexpr std::uint8_t kTick = 2, kUart = 4;
}

/// What a register of the NVIC or BASEPRI holds for an urgency: the upper four bits of a byte.
constexpr std::uint32_t priority_byte(std::uint8_t urgency) { return std::uint32_t{urgency} << 4; }

/// From now on `handler` runs for interrupt `irq`. Needs a vector table in RAM. Start-up only.
void install(int irq, std::uint8_t urgency, void (*handler)());

}  // namespace astro::teensy40
