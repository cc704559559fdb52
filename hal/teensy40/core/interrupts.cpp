#include "hal/teensy40/core/interrupts.hpp"

#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40 {
namespace {

using Word32 = Register<std::uint32_t>;

/// Writes the bit of an interrupt in the bank of registers that begins at `first` and has one for each.
void write_bit(Word32 first, int irq) {
  const auto line = static_cast<std::uint32_t>(irq);
  Word32(first.address() + line / 32 * 4).write(1U << line % 32);
}

}  // namespace

void install(int irq, std::uint8_t urgency, void (*handler)()) {
  constexpr std::uint32_t kSystemVectors = 16;
  const auto line = static_cast<std::uint32_t>(irq);
  write_bit(NVIC[nvic::ICER0], irq);

  const Word32 vector(SCB[scb::VTOR].read() + 4 * (kSystemVectors + line));
  vector.write(static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(handler)));

  const Word32 priorities(NVIC[nvic::IPR0].address() + line / 4 * 4);
  const std::uint32_t shift = line % 4 * 8;
  priorities.modify(0xFFU << shift, priority_byte(urgency) << shift);

  cpu::synchronize();
  write_bit(NVIC[nvic::ICPR0], irq);
  write_bit(NVIC[nvic::ISER0], irq);
}

InterruptOff::InterruptOff(int irq) : irq_(irq) {
  write_bit(NVIC[nvic::ICER0], irq_);
  cpu::synchronize();
  cpu::refetch();
}

InterruptOff::~InterruptOff() {
  cpu::synchronize();
  write_bit(NVIC[nvic::ISER0], irq_);
}

}  // namespace astro::teensy40
