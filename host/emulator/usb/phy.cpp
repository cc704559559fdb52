#include "host/emulator/usb/phy.hpp"

#include "hal/teensy40/registers/registers.hpp"

namespace astro::emulator {

using namespace teensy40;

UsbPhy::UsbPhy()
    : Stored({{usbphy::PWD.value, 0x001E'1C00},
              {usbphy::TX.value, 0x1006'0607},
              {usbphy::CTRL.value, 0xC020'0000}}) {}

void UsbPhy::write(std::uint32_t offset, std::uint32_t written) {
  const std::uint32_t base = offset & ~0xFU, old = value(base);
  store(base, (offset & 0xF) == 4 ? old | written : (offset & 0xF) == 8 ? old & ~written : written);
}

bool UsbPhy::ready() const {
  const std::uint32_t ctrl = value(usbphy::CTRL.value);
  return value(usbphy::PWD.value) == 0 && usbphy::CTRL_SFTRST.of(ctrl) == 0 &&
         usbphy::CTRL_CLKGATE.of(ctrl) == 0;
}

}  // namespace astro::emulator
