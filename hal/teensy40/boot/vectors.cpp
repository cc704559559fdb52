#include "hal/teensy40/boot/vectors.hpp"

#include <array>

#include "hal/teensy40/arithmetic/reset_cause.hpp"
#include "hal/teensy40/boot/start.hpp"
#include "hal/teensy40/cpu.hpp"
#include "hal/teensy40/motors.hpp"

extern "C" const std::uint8_t stack_bottom, stack_top;

namespace astro::teensy40::vectors {
namespace {

constexpr std::size_t kEntries = 16 + 160;

[[gnu::section(".vectors")]] std::array<std::uintptr_t, kEntries> table;

/// What the ROM may have left running would find no handler and restart the chip for ever.
void silence_interrupts() {
  constexpr std::uint32_t kBanks = 160 / 32;
  SysTick[systick::CSR].write(0);
  for (std::uint32_t bank = 0; bank < kBanks; ++bank) {
    Register<std::uint32_t>(NVIC[nvic::ICER0].address() + 4 * bank).write(~0U);
    Register<std::uint32_t>(NVIC[nvic::ICPR0].address() + 4 * bank).write(~0U);
  }
}

/// The program counter that the core put on the stack, if there still is one.
std::uint32_t where(std::uint32_t frame) {
  constexpr std::uint32_t kBytes = 32, kProgramCounter = 24;
  const auto bottom = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&stack_bottom));
  const auto top = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&stack_top));
  if (frame < bottom || frame > top - kBytes) return 0;
  return *reinterpret_cast<const volatile std::uint32_t*>(std::uintptr_t{frame} + kProgramCounter);
}

}  // namespace

extern "C" [[noreturn, gnu::used]] void end_by_fault(std::uint32_t exception, std::uint32_t frame) {
  Motors::coast();
  SRC[src::GPR5].write(marker::kFault);
  SRC[src::GPR6].write(exception);
  SRC[src::GPR7].write(where(frame));
  SRC[src::GPR8].write(SCB[scb::CFSR].read());
  cpu::synchronize();
  SCB[scb::AIRCR].write(scb::AIRCR_VECTKEY(0x05FA) | scb::AIRCR_SYSRESETREQ(1));
  cpu::synchronize();
  while (true) {
  }
}

/// The stack may be what has failed: it begins anew, and what was on it is given up.
extern "C" [[gnu::naked]] void fault_handler() {
  asm volatile(
      "cpsid i\n"
      "mrs r0, ipsr\n"
      "mov r1, sp\n"
      "ldr r2, =stack_top\n"
      "mov sp, r2\n"
      "b end_by_fault\n"
      ".ltorg\n");
}

void start() {
  silence_interrupts();
  const auto handler = reinterpret_cast<std::uintptr_t>(fault_handler);
  table.fill(handler);
  table[0] = reinterpret_cast<std::uintptr_t>(&stack_top);
  table[1] = reinterpret_cast<std::uintptr_t>(reset);
  SCB[scb::VTOR].write(static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(table.data())));
  SCB[scb::SHCSR].modify(0,
                         scb::SHCSR_MEMFAULTENA(1) | scb::SHCSR_BUSFAULTENA(1) | scb::SHCSR_USGFAULTENA(1));
  cpu::synchronize();
  asm volatile("cpsie i" ::: "memory");
}

}  // namespace astro::teensy40::vectors
