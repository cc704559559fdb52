#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "hal/teensy40/registers/registers.hpp"
#include "host/emulator/core/machine.hpp"

namespace astro::emulator {

/// Which rule of a watchdog was broken. The last two are about WDOG1 and WDOG2; their value is the watchdog's
/// number.
enum class WatchdogProblem {
  update_forbidden,
  unlocked_from_flash,
  wrong_key,
  not_unlocked,
  clock_not_modelled,
  window_not_modelled,
  started_again,
  power_down_not_stopped
};

/// Watchdog 3. The boot ROM may or may not have switched it off.
class Rtwdog : public Model {
 public:
  explicit Rtwdog(Machine& machine) : machine_(machine) {}

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void event() override { machine_.restart(Reset::watchdog); }
  void reset() override;
  void leave_rom_state() override;

  bool running() const;

 private:
  void write_key(std::uint32_t value);
  void configure(std::uint32_t offset, std::uint32_t value);
  bool unlocked() const { return machine_.now() < unlocked_until_; }
  Cycles timeout() const;
  void feed();

  Machine& machine_;
  std::uint32_t control_ = 0, timeout_counts_ = 0, window_ = 0;
  std::uint32_t half_key_ = 0;
  bool configured_ = false;
  Cycles unlocked_until_ = 0;
};

/// WDOG1 or WDOG2. The firmware only stops their power-down counter, which runs from reset on and pulls the
/// pin WDOG_B after 16 s unless WMCR.PDE is cleared before.
class Wdog : public Model {
 public:
  Wdog(Machine& machine, int number) : machine_(machine), number_(number) {}

  std::uint32_t read(std::uint32_t) override { return counting_ ? 1 : 0; }
  void write(std::uint32_t, std::uint32_t value) override {
    if (!counting_ && (value & 1) != 0)
      machine_.fail({fmt::format("WDOG{} WMCR: what has been stopped cannot be started again", number_),
                     WatchdogProblem::started_again,
                     {std::to_string(number_)}});
    counting_ = (value & 1) != 0;
    if (!counting_) machine_.wake(*this, kNever);
  }
  void event() override {
    machine_.fail({fmt::format("WDOG{} WMCR: the power-down counter has run for 16 s", number_),
                   WatchdogProblem::power_down_not_stopped,
                   {std::to_string(number_)}});
  }
  void reset() override {
    counting_ = true;
    machine_.wake(*this, machine_.now() + 16 * kCyclesPerSecond);
  }

 private:
  Machine& machine_;
  int number_;
  bool counting_ = true;
};

}  // namespace astro::emulator
