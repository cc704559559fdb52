#pragma once

#include "hal/rp2040/uart.hpp"
#include "hal/rp2040/usb/usb_serial.hpp"
#include "hal/usb/ports.hpp"

namespace astro::rp2040 {

/// Port 1 is the UART on GP0 and GP1.
using Ports = usb_device::Ports<UsbSerial, Uart>;

}  // namespace astro::rp2040
