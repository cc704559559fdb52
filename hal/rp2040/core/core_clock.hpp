#pragma once

#include "hal/rp2040/registers/registers.hpp"

/// The clocks. Inline, because the only caller runs in the flash before anything has been copied.
namespace astro::rp2040::core_clock {

#define ASTRO_INLINE [[gnu::always_inline]] inline

inline constexpr std::uint32_t kSystem_Hz = 125'000'000, kCrystal_Hz = 12'000'000;

/// 12 MHz * `multiplier` / (`first` * `second`). The oscillator inside must be between 750 and 1600 MHz.
ASTRO_INLINE void start_pll(Peripheral<pll::Type> unit, std::uint32_t multiplier, std::uint32_t first,
                            std::uint32_t second) {
  unit[pll::CS].write(pll::CS_REFDIV(1));
  unit[pll::FBDIV_INT].write(multiplier);
  unit[pll::PWR].clear(pll::PWR_PD.mask() | pll::PWR_VCOPD.mask());
  while (unit[pll::CS].get(pll::CS_LOCK) == 0) {
  }
  unit[pll::PRIM].write(pll::PRIM_POSTDIV1(first) | pll::PRIM_POSTDIV2(second));
  unit[pll::PWR].clear(pll::PWR_POSTDIVPD.mask());
}

/// The crystal of a Pico starts within a millisecond; other boards' need more. The counter counts 256 clocks.
ASTRO_INLINE void start_crystal() {
  constexpr std::uint32_t kRange = 0xAA0, kOn = 0xFAB, kDelay_ms = 4;
  XOSC[xosc::STARTUP].write(xosc::STARTUP_DELAY(kCrystal_Hz / 1000 * kDelay_ms / 256));
  XOSC[xosc::CTRL].write(xosc::CTRL_FREQ_RANGE(kRange) | xosc::CTRL_ENABLE(kOn));
  while (XOSC[xosc::STATUS].get(xosc::STATUS_STABLE) == 0) {
  }
}

/// The system clock runs from the reference and that from the crystal; neither depends on a PLL then.
ASTRO_INLINE void run_from_crystal() {
  constexpr std::uint32_t kFromCrystal = 2;
  CLOCKS[clocks::CLK_SYS_CTRL].clear(clocks::CLK_SYS_CTRL_SRC.mask());
  while (CLOCKS[clocks::CLK_SYS_SELECTED].read() != 1) {
  }
  CLOCKS[clocks::CLK_REF_CTRL].write(clocks::CLK_REF_CTRL_SRC(kFromCrystal));
  while (CLOCKS[clocks::CLK_REF_SELECTED].read() != 1U << kFromCrystal) {
  }
}

/// 125 MHz core, bus and serial port, 48 MHz for USB and converter, a microsecond's tick for the timer.
ASTRO_INLINE void start() {
  CLOCKS[clocks::CLK_SYS_RESUS_CTRL].write(0);
  start_crystal();
  run_from_crystal();
  constexpr std::uint32_t kPlls = resets::RESET_PLL_SYS.mask() | resets::RESET_PLL_USB.mask();
  RESETS[resets::RESET].set(kPlls);
  RESETS[resets::RESET].clear(kPlls);
  while ((RESETS[resets::RESET_DONE].read() & kPlls) != kPlls) {
  }
  start_pll(PLL_SYS, 125, 6, 2);
  start_pll(PLL_USB, 100, 5, 5);
  // AUXSRC 0 is PLL_SYS here; it must not change while it is in use.
  CLOCKS[clocks::CLK_SYS_CTRL].write(0);
  CLOCKS[clocks::CLK_SYS_CTRL].set(clocks::CLK_SYS_CTRL_SRC.mask());
  while (CLOCKS[clocks::CLK_SYS_SELECTED].read() != 2) {
  }
  CLOCKS[clocks::CLK_PERI_CTRL].write(clocks::CLK_PERI_CTRL_ENABLE(1));  // AUXSRC 0: the system clock
  CLOCKS[clocks::CLK_USB_CTRL].write(clocks::CLK_USB_CTRL_ENABLE(1));    // AUXSRC 0: PLL_USB
  CLOCKS[clocks::CLK_ADC_CTRL].write(clocks::CLK_ADC_CTRL_ENABLE(1));    // AUXSRC 0: PLL_USB
  WATCHDOG[watchdog::TICK].write(watchdog::TICK_ENABLE(1) | watchdog::TICK_CYCLES(kCrystal_Hz / 1'000'000));
}

#undef ASTRO_INLINE

}  // namespace astro::rp2040::core_clock
