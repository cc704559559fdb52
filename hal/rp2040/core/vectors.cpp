#include "hal/rp2040/core/vectors.hpp"

#include <array>

#include "hal/rp2040/arithmetic/reset_cause.hpp"
#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/core/start.hpp"
#include "hal/rp2040/motors.hpp"
#include "hal/rp2040/watchdog.hpp"

extern "C" const std::uint8_t stack_bottom, stack_top;

namespace astro::rp2040::vectors {
namespace {

constexpr std::size_t kEntries = 16 + 32;

[[gnu::section(".vectors")]] std::array<std::uint32_t, kEntries> table;

std::uint32_t address_of(const void* object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object));
}

/// What ran before, the boot ROM or a debugger, may have left interrupts pending.
void silence_interrupts() {
  constexpr std::uint32_t kDropSysTick = 1U << 25, kDropPendSv = 1U << 27;  // ICSR: PENDSTCLR, PENDSVCLR
  PPB[ppb::SYST_CSR].write(0);
  PPB[ppb::NVIC_ICER].write(~0U);
  PPB[ppb::NVIC_ICPR].write(~0U);
  PPB[ppb::ICSR].write(kDropSysTick | kDropPendSv);
}

/// The program counter that the core has saved on the stack; 0 if `frame` is not in the stack.
std::uint32_t where(std::uint32_t frame) {
  constexpr std::uint32_t kBytes = 32, kProgramCounter = 24;
  if (frame % 4 != 0 || frame < address_of(&stack_bottom) || frame > address_of(&stack_top) - kBytes)
    return 0;
  return Register(frame + kProgramCounter).read();
}

}  // namespace

extern "C" [[noreturn, gnu::used]] void end_by_fault(std::uint32_t exception, std::uint32_t frame) {
  Motors::coast();
  WATCHDOG[watchdog::SCRATCH1].write(exception);
  WATCHDOG[watchdog::SCRATCH2].write(where(frame));
  watchdog_timer::restart(marker::kFault);
}

/// The stack itself may have failed, so it is reset and its content is lost. The handler returns to nobody, so it may use
/// every register.
extern "C" [[gnu::naked]] void fault_handler() {
  asm volatile(
      "cpsid i\n"
      "mrs r0, ipsr\n"
      "mov r1, sp\n"
      "ldr r2, =stack_top\n"
      "mov sp, r2\n"
      "ldr r2, =end_by_fault\n"
      "bx r2\n"
      ".ltorg\n");
}

void start() {
  silence_interrupts();
  table.fill(static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(fault_handler)));
  table[0] = address_of(&stack_top);
  table[1] = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(reset));
  PPB[ppb::VTOR].write(address_of(table.data()));
  cpu::synchronize();
  asm volatile("cpsie i" ::: "memory");
}

}  // namespace astro::rp2040::vectors
