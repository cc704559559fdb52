#pragma once

#include <cstdint>

namespace astro::teensy40 {

namespace irq {
inline constexpr int kLpuart6 = 25, kUsb1 = 113, kPit = 122;
}

/// Urgency of interrupts: a smaller number is more urgent, in 16 levels. Only faults use 0. The serial port
/// is more urgent than USB: its queue of four bytes overflows after 40 us, while a USB host just repeats its
/// request.
namespace urgency {
inline constexpr std::uint8_t kTick = 2, kUart = 4, kUsb = 6;
}

/// An urgency as NVIC and BASEPRI hold it: the upper four bits of a byte.
constexpr std::uint32_t priority_byte(std::uint8_t urgency) { return std::uint32_t{urgency} << 4; }

/// From now on `handler` runs for interrupt `irq`. Needs a vector table in RAM. Start-up only.
void install(int irq, std::uint8_t urgency, void (*handler)());

/// Interrupt `irq` waits while such an object lives. The objects do not nest.
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
