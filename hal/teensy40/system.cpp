#include "hal/teensy40/system.hpp"

#include "hal/teensy40/arithmetic/reset_cause.hpp"
#include "hal/teensy40/clock.hpp"
#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/motors.hpp"

namespace astro::teensy40 {
namespace {

constexpr std::uint32_t kResetKey = 0x05FA;
constexpr std::uint32_t kSignedOnly = 1U << 1;  // in fuse word CFG5

/// The Teensy's second chip watches the debug port, and any `bkpt` makes it start the boot loader. This is
/// the only one in the image.
[[gnu::noinline]] void call_halfkay() { asm volatile("bkpt #251" ::: "memory"); }

}  // namespace

void System::leave_ports() {
  constexpr std::uint64_t kGone_us = 5'000;  // so that the host notices the robot's departure first
  usb_.detach();
  uart_.stop();
  const Clock clock;
  const std::uint64_t begun_us = clock.now_us();
  while (clock.now_us() - begun_us < kGone_us) {
  }
}

void System::start() {
  open_gate(CCM[ccm::CCGR2], ccm::CCGR2_CG6);
  id_ = teensy40::unique_id({OCOTP[ocotp::CFG0].read(), OCOTP[ocotp::CFG1].read(), OCOTP[ocotp::MAC0].read(),
                             OCOTP[ocotp::MAC1].read()});
  const std::uint32_t causes = SRC[src::SRSR].read();
  cause_ = teensy40::reset_cause(causes, SRC[src::GPR5].read());
  SRC[src::SRSR].write(causes);
  SRC[src::GPR5].write(marker::kNone);
}

void System::reboot() noexcept {
  const cpu::InterruptsOff guard;  // no tick may drive again
  Motors::coast();
  SRC[src::GPR5].write(marker::kReboot);
  cpu::synchronize();
  SCB[scb::AIRCR].write(scb::AIRCR_VECTKEY(kResetKey) | scb::AIRCR_SYSRESETREQ(1));
  cpu::synchronize();
  while (true) {
  }
}

bool System::enter_bootloader() noexcept {
  if ((OCOTP[ocotp::CFG5].read() & kSignedOnly) != 0) return false;
  const cpu::InterruptsOff guard;  // no tick may drive again
  Motors::coast();
  leave_ports();
  watchdog::stop();
  call_halfkay();
  return true;
}

}  // namespace astro::teensy40
