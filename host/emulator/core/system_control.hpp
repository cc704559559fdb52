#pragma once

#include <cstdint>
#include <functional>

#include "host/emulator/core/exceptions.hpp"
#include "host/emulator/core/machine.hpp"
#include "host/emulator/core/protection.hpp"

namespace astro::emulator {

/// Which rule of the core's own registers was broken. The value of tracing_off is the register.
enum class ControlProblem {
  reset_without_key,
  subpriorities,
  vectors_misaligned,
  tick_clock_changed,
  tracing_off
};

/// The core's own registers at 0xE0000000: NVIC, SCB, SysTick, MPU, cycle counter.
class SystemControl {
 public:
  SystemControl(Machine& machine, Exceptions& exceptions, Protection& protection)
      : machine_(machine), exceptions_(exceptions), protection_(protection) {}
  void reset();
  /// As a boot ROM may leave it: SysTick runs, and asks for its interrupt.
  void leave_rom_state();

  std::uint32_t read(std::uint32_t address);
  void write(std::uint32_t address, std::uint32_t value);

  Cycles next_event() const { return tick_at_; }
  void event();

  /// Called when the firmware drops the line of the data cache at an address.
  std::function<void(std::uint32_t)> on_invalidate = [](std::uint32_t) {};

  /// Whether the processor may cache this address, with MPU and caches as the firmware has set them.
  bool cached(std::uint32_t address) const;

 private:
  std::uint32_t read_nvic(std::uint32_t offset) const;
  void write_nvic(std::uint32_t offset, std::uint32_t value);
  std::uint32_t read_scb(std::uint32_t offset) const;
  void write_scb(std::uint32_t offset, std::uint32_t value);
  std::uint32_t read_priorities(int first) const;
  void write_priorities(int first, std::uint32_t value);
  void write_icsr(std::uint32_t value);
  void write_aircr(std::uint32_t value);
  Cycles tick_cycles() const;
  std::uint32_t read_tick(std::uint32_t offset);
  void write_tick(std::uint32_t offset, std::uint32_t value);
  std::uint32_t counter() const;
  void write_trace(std::uint32_t address, std::uint32_t value);

  Machine& machine_;
  Exceptions& exceptions_;
  Protection& protection_;
  bool counting_ = false;
  std::uint32_t ccr_ = 0, cpacr_ = 0, demcr_ = 0;
  Cycles counter_zero_ = 0;         // while it counts
  std::uint32_t counter_held_ = 0;  // while it does not
  std::uint32_t tick_control_ = 0, tick_reload_ = 0;
  bool tick_flag_ = false;
  Cycles tick_at_ = kNever;
};

}  // namespace astro::emulator
