#include "hal/rp2040/system.hpp"

#include "hal/rp2040/arithmetic/reset_cause.hpp"
#include "hal/rp2040/boot_rom.hpp"
#include "hal/rp2040/clock.hpp"
#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/flash.hpp"
#include "hal/rp2040/motors.hpp"

namespace astro::rp2040 {
namespace {

constexpr std::uint64_t kGone_us =
    5'000;  // so that the host notices the robot's departure before the loader comes

}  // namespace

void System::start() {
  watchdog_timer::stop();
  id_ = rp2040::unique_id(Flash::serial_number());
  cause_ = rp2040::reset_cause(WATCHDOG[watchdog::REASON].read(),
                               VREG_AND_CHIP_RESET[chip_reset::CHIP_RESET].read(),
                               WATCHDOG[watchdog::SCRATCH0].read());
  WATCHDOG[watchdog::SCRATCH0].write(marker::kNone);
}

void System::reboot() noexcept {
  const cpu::InterruptsOff guard;  // no tick may drive again
  Motors::coast();
  watchdog_timer::restart(marker::kReboot);
}

bool System::enter_bootloader() noexcept {
  using Loader = void (*)(std::uint32_t activity_pins, std::uint32_t disabled_interfaces);
  const auto loader = boot_rom::get<Loader>('U', 'B');
  if (loader == nullptr) return false;
  const cpu::InterruptsOff guard;  // no tick may drive again
  Motors::coast();
  WATCHDOG[watchdog::SCRATCH0].write(marker::kReboot);  // for the start after the loader
  watchdog_timer::stop();                               // nobody feeds it in the loader
  usb_.detach();
  const Clock clock;
  const std::uint64_t left_us = clock.now_us();
  while (clock.now_us() - left_us < kGone_us) {
  }
  loader(0, 0);
  return true;
}

}  // namespace astro::rp2040
