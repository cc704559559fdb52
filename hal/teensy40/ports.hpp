#pragma once

#include "hal/teensy40/uart.hpp"
#include "hal/teensy40/usb/usb_serial.hpp"
#include "hal/usb/ports.hpp"

namespace astro::teensy40 {

/// Port 1 is the UART on pins 0 and 1.
using Ports = usb_device::Ports<UsbSerial, Uart>;

}  // namespace astro::teensy40
