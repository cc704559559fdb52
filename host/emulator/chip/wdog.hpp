#pragma once

#include <fmt/format.h>

#include "hal/teensy40/registers/registers.hpp"
#include "host/emulator/core/machine.hpp"

namespace astro::emulator {

/// WDOG1 or WDOG2. The firmware only switches their power-down off: a counter runs from reset on and pulls
/// the pin WDOG_B after 16 s unless WMCR.PDE is cleared before.
class Wdog : public Model {
 public:
  Wdog(Machine& machine, int number) : machine_(machine), number_(number) {}

  std::uint32_t read(std::uint32_t) override { return counting_ ? 1 : 0; }
  void write(std::uint32_t, std::uint32_t value) override {
    if (!counting_ && (value & 1) != 0)
      machine_.fail(fmt::format("WDOG{} WMCR: what has been stopped cannot be started again", number_));
    counting_ = (value & 1) != 0;
    if (!counting_) machine_.wake(*this, kNever);
  }
  void event() override {
    machine_.fail(fmt::format("WDOG{} WMCR: the power-down counter has run for 16 s", number_));
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
