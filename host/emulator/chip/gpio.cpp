#include "host/emulator/chip/gpio.hpp"

#include <fmt/format.h>

namespace astro::emulator {

using namespace teensy40;

std::uint32_t Gpio::read(std::uint32_t offset) {
  if (offset == gpio::DR.value) return data_;
  if (offset == gpio::GDIR.value) return direction_;
  if (offset == gpio::PSR.value) return (data_ & direction_) | (inputs_ & ~direction_);
  return 0;
}

/// A port cannot move a pin that belongs to the other view of the pads.
void Gpio::check_owner(std::uint32_t touched, const char* what) {
  const bool fast = port_ >= 6;
  const int slow_port = fast ? port_ - 5 : port_;
  const std::uint32_t fast_pins = gpr_.fast_pins(slow_port);
  if ((touched & (fast ? ~fast_pins : fast_pins)) != 0)
    machine_.fail({fmt::format("GPIO{} {}: moves pins that belong to GPIO{} (IOMUXC_GPR GPR{})", port_, what,
                               fast ? slow_port : port_ + 5, 25 + slow_port),
                   GpioProblem::pins_of_other_port,
                   {std::to_string(port_), what, std::to_string(fast ? slow_port : port_ + 5)}});
}

void Gpio::set_data(std::uint32_t data, std::uint32_t touched) {
  check_owner(touched, "DR");
  data_ = data;
}

void Gpio::write(std::uint32_t offset, std::uint32_t value) {
  if (offset == gpio::DR.value) set_data(value, data_ ^ value);
  if (offset == gpio::DR_SET.value) set_data(data_ | value, value);
  if (offset == gpio::DR_CLEAR.value) set_data(data_ & ~value, value);
  if (offset == gpio::DR_TOGGLE.value) set_data(data_ ^ value, value);
  if (offset == gpio::GDIR.value) {
    check_owner(direction_ ^ value, "GDIR");
    direction_ = value;
  }
  if (offset == gpio::PSR.value)
    machine_.fail({fmt::format("GPIO{} PSR: cannot be written", port_),
                   GpioProblem::pad_state_written,
                   {std::to_string(port_)}});
  if (offset == gpio::IMR.value && value != 0)
    machine_.fail({fmt::format("GPIO{} IMR: interrupts of the pins are not modelled", port_),
                   GpioProblem::interrupts_not_modelled,
                   {std::to_string(port_)}});
  on_change();
}

}  // namespace astro::emulator
