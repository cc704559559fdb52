#include "host/emulator/usb/endpoints.hpp"

#include <fmt/format.h>

#include "hal/teensy40/registers/registers.hpp"

namespace astro::emulator {

using namespace teensy40;

bool Endpoints::enabled(int endpoint, bool in) const {
  return (in ? usb::ENDPTCTRL1_TXE : usb::ENDPTCTRL1_RXE).of(control(static_cast<std::size_t>(endpoint))) !=
         0;
}

bool Endpoints::stalled(int endpoint, bool in) const {
  return (in ? usb::ENDPTCTRL1_TXS : usb::ENDPTCTRL1_RXS).of(control(static_cast<std::size_t>(endpoint))) !=
         0;
}

void Endpoints::write_control(std::size_t number, std::uint32_t value, Machine& machine) {
  constexpr std::uint32_t kControlType = 0;
  const int endpoint = static_cast<int>(number);
  if (endpoint != 0) {
    const bool in = usb::ENDPTCTRL1_TXE.of(value) != 0, out = usb::ENDPTCTRL1_RXE.of(value) != 0;
    if ((!in && pipe(endpoint, true).primed()) || (!out && pipe(endpoint, false).primed()))
      machine.fail(
          fmt::format("USB1 ENDPTCTRL{}: switched off with a transfer under way: flush it first", endpoint));
    if ((in && usb::ENDPTCTRL1_RXT.of(value) == kControlType) ||
        (out && usb::ENDPTCTRL1_TXT.of(value) == kControlType))
      machine.fail(
          fmt::format("USB1 ENDPTCTRL{}: the direction without use is left as a control endpoint", endpoint));
    if (usb::ENDPTCTRL1_TXR.of(value) != 0) pipe(endpoint, true).begin_with_data0();
    if (usb::ENDPTCTRL1_RXR.of(value) != 0) pipe(endpoint, false).begin_with_data0();
  }
  control_[number] = value & ~(usb::ENDPTCTRL1_TXR.mask() | usb::ENDPTCTRL1_RXR.mask());
  if (endpoint == 0) control_[0] |= kAlwaysOn;
}

std::uint32_t Endpoints::primed() const {
  std::uint32_t bits = 0;
  for (int endpoint = 0; endpoint < static_cast<int>(kCount); ++endpoint)
    for (const bool in : {false, true})
      if (pipe(endpoint, in).primed()) bits |= bit_of(endpoint, in);
  return bits;
}

void Endpoints::flush(std::uint32_t bits) {
  for (int endpoint = 0; endpoint < static_cast<int>(kCount); ++endpoint)
    for (const bool in : {false, true})
      if ((bits & bit_of(endpoint, in)) != 0) pipe(endpoint, in).flush();
}

void Endpoints::take_setup() {
  control_[0] &= ~(usb::ENDPTCTRL0_RXS.mask() | usb::ENDPTCTRL0_TXS.mask());
  for (const bool in : {false, true}) pipe(0, in).take_setup();
}

}  // namespace astro::emulator
