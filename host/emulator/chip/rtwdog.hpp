#pragma once

#include <cstdint>

#include "host/emulator/core/machine.hpp"

namespace astro::emulator {

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

}  // namespace astro::emulator
