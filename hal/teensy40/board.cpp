#include "hal/teensy40/board.hpp"

#include "hal/teensy40/interrupts.hpp"

namespace astro::teensy40 {
namespace {

UsbSerial* usb_port = nullptr;

void usb_interrupt() { usb_port->interrupt(); }

}  // namespace

Board::Board() {
  motors_.start();
  system_.start();
  encoders_.start();
  battery_.start();
  uart_.start();
  serial_number_ = serial_number(system_.unique_id());
  usb_port = &usb_;
  install(irq::kUsb1, urgency::kUsb, usb_interrupt);
  usb_.start({serial_number_.data(), serial_number_.size()});
  watchdog::start();
}

}  // namespace astro::teensy40
