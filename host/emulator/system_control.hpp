#pragma once

#include <array>
#include <cstdint>

#include "host/emulator/exceptions.hpp"
#include "host/emulator/machine.hpp"

namespace astro::emulator {

/// The core's own registers at 0xE0000000: NVIC, SCB, SysTick, MPU, cycle counter.
class SystemControl {
 public:
  struct Region {
    std::uint32_t base = 0, attributes = 0;  // RBAR, RASR
  };

  SystemControl(Machine& machine, Exceptions& exceptions) : machine_(machine), exceptions_(exceptions) {}
  void reset();

  std::uint32_t read(std::uint32_t address);
  void write(std::uint32_t address, std::uint32_t value);

  Cycles next_event() const { return tick_at_; }
  void event();

  /// As the firmware has set the MPU: whether the processor may keep a copy of this address in a cache.
  bool cached(std::uint32_t address) const;
  bool protection_on() const { return mpu_on_; }
  const Region& region(std::size_t number) const { return regions_[number]; }

 private:
  std::uint32_t read_nvic(std::uint32_t offset) const;
  void write_nvic(std::uint32_t offset, std::uint32_t value);
  std::uint32_t read_scb(std::uint32_t offset) const;
  void write_scb(std::uint32_t offset, std::uint32_t value);
  std::uint32_t read_priorities(int first) const;
  void write_priorities(int first, std::uint32_t value);
  void write_icsr(std::uint32_t value);
  Cycles tick_cycles() const;

  Machine& machine_;
  Exceptions& exceptions_;
  std::array<Region, 16> regions_{};
  std::size_t region_ = 0;
  bool mpu_on_ = false, counting_ = false;
  std::uint32_t ccr_ = 0, cpacr_ = 0, demcr_ = 0;
  Cycles counter_zero_ = 0;
  std::uint32_t tick_control_ = 0, tick_reload_ = 0;
  bool tick_flag_ = false;
  Cycles tick_at_ = kNever;
};

}  // namespace astro::emulator
