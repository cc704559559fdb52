#pragma once

#include <cstdint>

namespace astro::teensy40 {

namespace irq {
inline constexpr int kLpuart6 = 25, kUsb1 = 113, kPit = 122;
}

/// Urgency, smaller is more; the chip knows 16 levels. Faults have 0 for themselves. The serial port comes
/// before USB: its queue of four bytes overflows after 40 us, while a USB host just asks again.
namespace urgency {
inline constexpr std::uint8_t kTick = 2, kUart = 4, kUsb = 6;
}

/// What a register of the NVIC or BASEPRI holds for an urgency: the upper four bits of a byte.
constexpr std::uint32_t priority_byte(std::uint8_t urgency) { return std::uint32_t{urgency} << 4; }

/// From now on `handler` runs for interrupt `irq`. Needs a vector table in RAM. Start-up only.
void install(int irq, std::uint8_t urgency, void (*handler)());

/// While one lives, interrupt `irq` waits. They do not nest.
class [[nodiscard]] InterruptOff {
 public:
  explicit InterruptOff(int irq);
  ~InterruptOff();
  InterruptOff(const InterruptOff&) = delete;
  InterruptOff& operator=(const InterruptOff&) = delete;

 private:
  int irq_;
};

}  // namespace astro::teensy40
