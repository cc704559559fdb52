#include "hal/rp2040/core/start.hpp"

#include "hal/rp2040/core/core_clock.hpp"
#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/core/vectors.hpp"

// This code runs in the flash, before the rest has been copied to SRAM. Its constants must be in the flash, too, and the
// compiler must not turn a loop into a call of memcpy, which is not in SRAM yet.
#define IN_FLASH [[gnu::section(".boot"), gnu::noinline, gnu::optimize("no-tree-loop-distribute-patterns")]]

extern "C" {
extern std::uint32_t code_load, code_start, code_end;
extern std::uint32_t bss_start, bss_end;
extern void (*constructors_start)();
extern void (*constructors_end)();
}

int main();

namespace astro::rp2040 {
namespace {

[[noreturn, gnu::noinline]] void run() {
  vectors::start();
  wake(resets::RESET_TIMER.mask());
  for (void (**constructor)() = &constructors_start; constructor != &constructors_end; ++constructor)
    (*constructor)();
  main();
  while (true) {
  }
}

/// All but the flash's pins and its controller into reset, whatever has run before: then every pin is an input with a
/// pull-down, which keeps both bridges open.
[[gnu::always_inline]] inline void reset_peripherals() {
  constexpr std::uint32_t kAll = 0x01FF'FFFF;
  constexpr std::uint32_t kNeeded = resets::RESET_IO_QSPI.mask() | resets::RESET_PADS_QSPI.mask() |
                                    resets::RESET_SYSCFG.mask() | resets::RESET_PLL_SYS.mask() |
                                    resets::RESET_PLL_USB.mask();
  RESETS[resets::RESET].set(kAll & ~kNeeded);
}

}  // namespace

extern "C" [[noreturn]] void start_from_flash();

extern "C" IN_FLASH void start_from_flash() {
  reset_peripherals();
  core_clock::start();  // before the copy, which takes twenty times as long with the clock after reset
  const std::uint32_t* from = &code_load;
  for (std::uint32_t* to = &code_start; to < &code_end;) *to++ = *from++;
  for (std::uint32_t* word = &bss_start; word < &bss_end; ++word) *word = 0;
  cpu::synchronize();
  void (*volatile in_sram)() = run;  // farther away than a branch reaches
  in_sram();
  while (true) {
  }
}

extern "C" [[gnu::naked, gnu::section(".boot")]] void reset() {
  asm volatile(
      "cpsid i\n"
      "movs r0, #0\n"
      "msr control, r0\n"
      "isb\n"
      "ldr r0, =stack_top\n"
      "mov sp, r0\n"
      "ldr r0, =start_from_flash\n"
      "bx r0\n"
      ".ltorg\n");
}

}  // namespace astro::rp2040
