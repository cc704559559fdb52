#include "hal/teensy40/interrupts.hpp"

#include "hal/teensy40/cpu.hpp"
#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40 {
namespace {

using Word32 = Register<std::uint32_t>;

/// Register of the bank that begins at `first` and has one bit for each interrupt.
Word32 bank(Word32 first, int irq) { return Word32(first.address() + static_cast<unsigned>(irq) / 32 * 4); }

}  // namespace

void install(int irq, std::uint8_t urgency, void (*handler)()) {
  constexpr std::uint32_t kSystemVectors = 16;
  const auto line = static_cast<std::uint32_t>(irq);
  const std::uint32_t bit = 1U << line % 32;
  bank(NVIC[nvic::ICER0], irq).write(bit);

  const Word32 vector(SCB[scb::VTOR].read() + 4 * (kSystemVectors + line));
  vector.write(static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(handler)));

  const Word32 priorities(NVIC[nvic::IPR0].address() + line / 4 * 4);
  const std::uint32_t shift = line % 4 * 8;
  priorities.modify(0xFFU << shift, priority_byte(urgency) << shift);

  cpu::synchronize();
  bank(NVIC[nvic::ICPR0], irq).write(bit);
  bank(NVIC[nvic::ISER0], irq).write(bit);
}

InterruptOff::InterruptOff(int irq) : irq_(irq) {
  bank(NVIC[nvic::ICER0], irq_).write(1U << (static_cast<std::uint32_t>(irq_) % 32));
  cpu::synchronize();
  cpu::refetch();
}

InterruptOff::~InterruptOff() {
  cpu::synchronize();
  bank(NVIC[nvic::ISER0], irq_).write(1U << (static_cast<std::uint32_t>(irq_) % 32));
}

}  // namespace astro::teensy40
