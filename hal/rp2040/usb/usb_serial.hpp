#pragma once

#include "hal/rp2040/usb/controller.hpp"
#include "hal/usb/usb_serial.hpp"

namespace astro::rp2040 {

using UsbSerial = usb_device::UsbSerial<UsbController>;

}  // namespace astro::rp2040
