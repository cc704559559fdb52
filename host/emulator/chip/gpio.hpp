#pragma once

#include <cstdint>
#include <functional>

#include "host/emulator/chip/iomuxc.hpp"

namespace astro::emulator {

/// What a port cannot do. The first value is the port's number; for pins_of_other_port the register and the
/// number of that port follow.
enum class GpioProblem { pins_of_other_port, pad_state_written, interrupts_not_modelled };

/// One GPIO port. GPR26..29 decide which pins it has, because 1..4 and 6..9 are two views of the same pads.
///
/// Not modelled  interrupts of the pins.
class Gpio : public Model {
 public:
  Gpio(Machine& machine, const IomuxcGpr& gpr, int port) : machine_(machine), gpr_(gpr), port_(port) {}

  std::uint32_t read(std::uint32_t offset) override;
  void write(std::uint32_t offset, std::uint32_t value) override;
  void reset() override { data_ = direction_ = 0; }

  /// Levels of the pins that are outputs.
  std::uint32_t driven() const { return data_ & direction_; }
  std::uint32_t outputs() const { return direction_; }
  /// Called when outputs, or what they drive, may have changed.
  std::function<void()> on_change = [] {};
  /// Sets the levels that the world applies to the pins that are inputs.
  void set_inputs(std::uint32_t levels) { inputs_ = levels; }

 private:
  void set_data(std::uint32_t data, std::uint32_t touched);
  void check_owner(std::uint32_t touched, const char* what);

  Machine& machine_;
  const IomuxcGpr& gpr_;
  int port_;
  std::uint32_t data_ = 0, direction_ = 0, inputs_ = ~0U;
};

}  // namespace astro::emulator
