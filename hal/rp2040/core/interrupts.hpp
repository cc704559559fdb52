#pragma once

#include <cstdint>

namespace astro::rp2040 {

namespace irq {
inline constexpr std::uint32_t kTimer0 = 0, kUsb = 5, kUart0 = 20;
}

/// Urgency of interrupts: a smaller number is more urgent, in four levels.
namespace urgency {
inline constexpr std::uint8_t kTick = 0, kUart = 1, kUsb = 2;
}

/// From now on `handler` runs for interrupt `irq`. Needs a vector table in RAM. Start-up only.
void install(std::uint32_t irq, std::uint8_t urgency, void (*handler)());

/// Interrupt `irq` waits while such an object lives. The objects do not nest.
class [[nodiscard]] InterruptOff {
 public:
  explicit InterruptOff(std::uint32_t irq);
  ~InterruptOff();
  InterruptOff(const InterruptOff&) = delete;
  InterruptOff& operator=(const InterruptOff&) = delete;

 private:
  std::uint32_t line_;
};

}  // namespace astro::rp2040
