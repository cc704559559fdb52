#include "hal/teensy40/core/vectors.hpp"

#include <array>

#include "hal/teensy40/arithmetic/reset_cause.hpp"
#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/core/start.hpp"
#include "hal/teensy40/motors.hpp"

extern "C" const std::uint8_t stack_bottom, stack_top;

namespace astro::teensy40::vectors {
namespace {

constexpr std::size_t kEntries = 16 + 160;

[[gnu::section(".vectors")]] std::array<std::uintptr_t, kEntries> table;

/// An interrupt that the ROM has left pending would find no handler and restart the chip again and again.
void silence_interrupts() {
  constexpr std::uint32_t kBanks = 160 / 32;
  constexpr std::uint32_t kDropSysTick = 1U << 25, kDropPendSv = 1U << 27;  // ICSR: PENDSTCLR, PENDSVCLR
  SysTick[systick::CSR].write(0);
  SCB[scb::ICSR].write(kDropSysTick | kDropPendSv);
  for (std::uint32_t bank = 0; bank < kBanks; ++bank) {
    Register<std::uint32_t>(NVIC[nvic::ICER0].address() + 4 * bank).write(~0U);
    Register<std::uint32_t>(NVIC[nvic::ICPR0].address() + 4 * bank).write(~0U);
  }
}

/// Bits of CFSR that mean that saving the registers on the stack, or restoring them, has failed, so the stack
/// does not hold them: MUNSTKERR, MSTKERR, MLSPERR, UNSTKERR, STKERR, LSPERR.
constexpr std::uint32_t kNoFrame = 1U << 3 | 1U << 4 | 1U << 5 | 1U << 11 | 1U << 12 | 1U << 13;

/// The program counter that the core has saved on the stack; 0 if that failed.
std::uint32_t where(std::uint32_t frame, std::uint32_t fault_status) {
  if ((fault_status & kNoFrame) != 0) return 0;
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
  const std::uint32_t fault_status = SCB[scb::CFSR].read();
  SRC[src::GPR7].write(where(frame, fault_status));
  SRC[src::GPR8].write(fault_status);
  cpu::synchronize();
  SCB[scb::AIRCR].write(scb::AIRCR_VECTKEY(0x05FA) | scb::AIRCR_SYSRESETREQ(1));
  cpu::synchronize();
  while (true) {
  }
}

/// The stack itself may have failed, so it is reset and its content is lost.
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
  SCB[scb::CFSR].write(~0U);  // faults in the ROM must not count as this program's
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
