#include "host/emulator/chip/watchdogs.hpp"

#include "hal/teensy40/registers/registers.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kUnlock = 0xD928'C520, kRefresh = 0xB480'A602;
constexpr std::uint32_t kAfterRom = 0x0000'2120;  // off; locked, but a key opens it
constexpr std::uint32_t kWindowOrInterrupt = 1U << 15 | 1U << 6, kLpo = 1;
constexpr Cycles kWindow = 128 * 4;  // clocks of the 150 MHz bus
constexpr Cycles kCyclesPerLpo = kCyclesPerSecond / 32'000;

}  // namespace

void Rtwdog::reset() {
  control_ = kAfterRom;
  timeout_counts_ = 0x400;
  window_ = half_key_ = 0;
  configured_ = true;
  unlocked_until_ = 0;
}

/// Leaves the watchdog running as after a reset: it resets the chip after 32 ms.
void Rtwdog::leave_rom_state() {
  control_ |= rtwdog::CS_EN(1);
  feed();
}

bool Rtwdog::running() const { return rtwdog::CS_EN.of(control_) != 0; }

Cycles Rtwdog::timeout() const {
  return Cycles{timeout_counts_} * (rtwdog::CS_PRES.of(control_) != 0 ? 256 : 1) * kCyclesPerLpo;
}

std::uint32_t Rtwdog::read(std::uint32_t offset) {
  if (offset == rtwdog::CS.value)
    return control_ | rtwdog::CS_ULK(unlocked()) | rtwdog::CS_RCS(configured_ && !unlocked());
  if (offset == rtwdog::TOVAL.value) return timeout_counts_;
  if (offset == rtwdog::WIN.value) return window_;
  return 0;
}

void Rtwdog::feed() { machine_.wake(*this, running() ? machine_.now() + timeout() : kNever); }

void Rtwdog::write_key(std::uint32_t value) {
  const std::uint32_t key = rtwdog::CS_CMD32EN.of(control_) != 0 ? value : half_key_ | value << 16;
  if (key == kUnlock) {
    if (rtwdog::CS_UPDATE.of(control_) == 0)
      return machine_.fail({"RTWDOG CNT: unlocked, but CS.UPDATE was 0", WatchdogProblem::update_forbidden});
    if (machine_.runs_from_flash())
      return machine_.fail(
          {"RTWDOG CNT: unlocked by code in the flash, whose next fetch may outlast the 128 bus clocks",
           WatchdogProblem::unlocked_from_flash});
    unlocked_until_ = machine_.now() + kWindow;
    configured_ = false;
  } else if (key == kRefresh) {
    feed();
  } else if (rtwdog::CS_CMD32EN.of(control_) == 0 &&
             (value == (kUnlock & 0xFFFF) || value == (kRefresh & 0xFFFF))) {
    half_key_ = value;
    return;
  } else {
    machine_.fail(
        {"RTWDOG CNT: neither the key that unlocks nor the one that feeds", WatchdogProblem::wrong_key});
  }
  half_key_ = 0;
}

/// Outside of the unlock window the chip silently ignores the write, so the model ends the run.
void Rtwdog::configure(std::uint32_t offset, std::uint32_t value) {
  if (!unlocked())
    return machine_.fail({"RTWDOG: configured without the key, or more than 128 bus clocks after it",
                          WatchdogProblem::not_unlocked});
  if (offset == rtwdog::TOVAL.value) timeout_counts_ = value & 0xFFFF;
  if (offset == rtwdog::WIN.value) window_ = value & 0xFFFF;
  if (offset != rtwdog::CS.value) return;
  if (rtwdog::CS_CLK.of(value) != kLpo)
    return machine_.fail(
        {"RTWDOG CS: only the 32 kHz oscillator is modelled", WatchdogProblem::clock_not_modelled});
  if ((value & kWindowOrInterrupt) != 0)
    return machine_.fail({"RTWDOG CS: neither its window nor its interrupt is modelled",
                          WatchdogProblem::window_not_modelled});
  control_ = value & ~(rtwdog::CS_ULK.mask() | rtwdog::CS_RCS.mask() | rtwdog::CS_FLG.mask());
  configured_ = true;
  unlocked_until_ = 0;
  feed();
}

void Rtwdog::write(std::uint32_t offset, std::uint32_t value) {
  if (offset == rtwdog::CNT.value)
    write_key(value);
  else
    configure(offset, value);
}

}  // namespace astro::emulator
