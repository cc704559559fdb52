#pragma once

#include "hal/teensy40/usb/controller.hpp"
#include "hal/usb/usb_serial.hpp"

namespace astro::teensy40 {

using UsbSerial = usb_device::UsbSerial<UsbController>;

}  // namespace astro::teensy40
