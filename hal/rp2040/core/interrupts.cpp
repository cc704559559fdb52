#include "hal/rp2040/core/interrupts.hpp"

#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/registers/registers.hpp"

namespace astro::rp2040 {

void install(std::uint32_t irq, std::uint8_t urgency, void (*handler)()) {
  constexpr std::uint32_t kSystemVectors = 16;
  PPB[ppb::NVIC_ICER].write(1U << irq);
  Register(PPB[ppb::VTOR].read() + 4 * (kSystemVectors + irq))
      .write(static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(handler)));
  // Words only; the upper two bits of a byte are the priority.
  const Register priorities(PPB[ppb::NVIC_IPR0].address() + irq / 4 * 4);
  const std::uint32_t shift = irq % 4 * 8;
  priorities.write((priorities.read() & ~(0xFFU << shift)) | std::uint32_t{urgency} << 6 << shift);
  cpu::synchronize();
  PPB[ppb::NVIC_ICPR].write(1U << irq);
  PPB[ppb::NVIC_ISER].write(1U << irq);
}

InterruptOff::InterruptOff(std::uint32_t irq) : line_(1U << irq) {
  PPB[ppb::NVIC_ICER].write(line_);
  cpu::synchronize();
  asm volatile("isb" ::: "memory");
}

InterruptOff::~InterruptOff() {
  cpu::synchronize();
  PPB[ppb::NVIC_ISER].write(line_);
}

}  // namespace astro::rp2040
