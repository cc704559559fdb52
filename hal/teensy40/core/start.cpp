#include "hal/teensy40/core/start.hpp"

#include "hal/teensy40/clock.hpp"
#include "hal/teensy40/core/core_clock.hpp"
#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/core/protection.hpp"
#include "hal/teensy40/core/vectors.hpp"
#include "hal/teensy40/pins.hpp"
#include "hal/teensy40/watchdog.hpp"

// This code runs in the flash, before the rest has been copied to RAM. Its constants must be in the flash,
// too, and the compiler must not turn a loop into a call of memcpy, which is not in RAM yet.
#define IN_FLASH [[gnu::section(".boot"), gnu::noinline, gnu::optimize("no-tree-loop-distribute-patterns")]]

extern "C" {
extern std::uint32_t code_load, code_start, code_end;
extern std::uint32_t data_load, data_start, data_end;
extern std::uint32_t bss_start, bss_end;
extern void (*constructors_start)();
extern void (*constructors_end)();
}

int main();

namespace astro::teensy40 {
namespace {

/// The other two watchdogs would pull a pin 16 s after a reset, because their clocks run unless the ROM has
/// stopped them.
void stop_power_down_counters() {
  open_gate(CCM[ccm::CCGR3], ccm::CCGR3_CG8);
  open_gate(CCM[ccm::CCGR5], ccm::CCGR5_CG5);
  WDOG1[wdog::WMCR].write(0);
  WDOG2[wdog::WMCR].write(0);
}

[[noreturn, gnu::noinline]] void run() {
  watchdog::stop();
  stop_power_down_counters();
  vectors::start();
  protection::start();
  core_clock::start();
  Clock::start();
  for (void (**constructor)() = &constructors_start; constructor != &constructors_end; ++constructor)
    (*constructor)();
  main();
  while (true) {
  }
}

/// The motor driver's inputs: six plain outputs, low. All pads are GPIO after a reset.
[[gnu::always_inline]] inline void hold_outputs_low() {
  constexpr std::uint32_t kOutputs = gpio7::kDirections | gpio7::kLeftPwm | gpio7::kRightPwm;
  IOMUXC_GPR[iomuxc_gpr::GPR27].write(~0U);  // GPIO2's pins to its fast copy
  GPIO7[gpio::DR_CLEAR].write(kOutputs);
  GPIO7[gpio::GDIR].modify(0, kOutputs);
  CCM[ccm::CCGR4].modify(0, ccm::CCGR4_CG9(3));  // so that a fault may silence FlexPWM2 at any time
}

[[gnu::always_inline]] inline void copy(std::uint32_t* to, const std::uint32_t* end,
                                        const std::uint32_t* from) {
  while (to < end) *to++ = *from++;
}

}  // namespace

extern "C" [[noreturn]] void start_from_flash();

extern "C" IN_FLASH void start_from_flash() {
  hold_outputs_low();
  PMU[pmu::MISC0_SET].write(pmu::MISC0_REFTOP_SELFBIASOFF(1));  // the reference is up by now
  copy(&code_start, &code_end, &code_load);
  copy(&data_start, &data_end, &data_load);
  for (std::uint32_t* word = &bss_start; word < &bss_end; ++word) *word = 0;
  cpu::synchronize();
  cpu::refetch();
  run();
}

/// First clears what the ROM may have left: interrupts, the process stack, MPU regions that would forbid the
/// following code, and masks that would block all interrupts. Then assigns 4 banks of 32 KB to code and 12 to
/// data; until that is done there is no stack and no data. GPR16's upper bits say where the core finds its
/// vectors after a reset and stay as they are.
extern "C" [[gnu::naked, gnu::section(".boot")]] void reset() {
  asm volatile(
      "cpsid i\n"
      "movs r0, #0\n"
      "msr control, r0\n"
      "ldr r1, =0xE000ED94\n"  // MPU_CTRL
      "str r0, [r1]\n"
      "dsb\n"
      "isb\n"
      "msr basepri, r0\n"
      "msr faultmask, r0\n"
      "ldr r0, =0x400AC000\n"  // IOMUXC_GPR
      "ldr r1, =0xAAAAAAFF\n"
      "str r1, [r0, #0x44]\n"  // GPR17
      "ldr r1, =0x00200007\n"
      "str r1, [r0, #0x40]\n"  // GPR16
      "ldr r1, =0x00AA0000\n"
      "str r1, [r0, #0x38]\n"  // GPR14
      "dsb\n"
      "isb\n"
      "ldr r0, =stack_top\n"
      "mov sp, r0\n"
      "b start_from_flash\n"
      ".ltorg\n");
}

}  // namespace astro::teensy40
