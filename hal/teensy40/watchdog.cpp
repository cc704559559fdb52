#include "hal/teensy40/watchdog.hpp"

#include "hal/teensy40/core/cpu.hpp"

namespace astro::teensy40::watchdog {
namespace {

constexpr std::uint32_t kUnlock = 0xD928'C520, kRefresh = 0xB480'A602;
constexpr std::uint32_t kSlow_Hz = 32'000 / 256;  // the low power oscillator behind the prescaler
constexpr std::uint32_t kTimeOut_counts = kTimeOut_ms * kSlow_Hz / 1000;
constexpr std::uint32_t kReads = 100'000;

constexpr std::uint32_t kStopped =
    rtwdog::CS_UPDATE(1) | rtwdog::CS_CLK(1) | rtwdog::CS_PRES(1) | rtwdog::CS_CMD32EN(1);
constexpr std::uint32_t kRunning = kStopped | rtwdog::CS_EN(1);

/// The configuration can be written within 128 bus clocks after the key, without interruption. So this runs
/// in ITCM with its constants, because a fetch from the flash may take longer than that.
void configure(std::uint32_t control, std::uint32_t timeout) {
  open_gate(CCM[ccm::CCGR5], ccm::CCGR5_CG2);
  const cpu::InterruptsOff guard;
  RTWDOG[rtwdog::CNT].write(kUnlock);
  static_cast<void>(poll(RTWDOG[rtwdog::CS], rtwdog::CS_ULK, 1, kReads));
  RTWDOG[rtwdog::WIN].write(0);
  RTWDOG[rtwdog::TOVAL].write(timeout);
  RTWDOG[rtwdog::CS].write(control);
  static_cast<void>(poll(RTWDOG[rtwdog::CS], rtwdog::CS_RCS, 1, kReads));
}

}  // namespace

void start() { configure(kRunning, kTimeOut_counts); }

void stop() { configure(kStopped, 0xFFFF); }

void feed() { RTWDOG[rtwdog::CNT].write(kRefresh); }

}  // namespace astro::teensy40::watchdog
