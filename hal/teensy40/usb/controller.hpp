#pragma once

#include "hal/teensy40/clock.hpp"
#include "hal/teensy40/core/interrupts.hpp"
#include "hal/usb/controller.hpp"

namespace astro::teensy40 {

/// The USB device controller at register level, as hal/usb/controller.hpp describes it.
struct UsbController {
  /// A Teensy 4.0 as a serial port.
  static constexpr usb_device::Identity kIdentity{0x16C0, 0x0483, 0x0279, usb_device::Speed::high};
  static constexpr std::uint32_t kBootloaderBaud = 134;

  struct InterruptOff : teensy40::InterruptOff {
    InterruptOff() : teensy40::InterruptOff(irq::kUsb1) {}
  };
  static void install(void (*handler)()) { teensy40::install(irq::kUsb1, urgency::kUsb, handler); }
  static std::uint64_t now_us() { return Clock().now_us(); }

  static void power_down();
  static void start();
  static void detach();
  static usb_device::Events take_events();
  static bool clean_up_after_reset();
  static usb_device::Speed speed();
  static void set_address(std::uint8_t address);
  static void open_endpoints(usb_device::Speed speed);
  static void close_endpoints();
  static void stall(usb_device::Pipe pipe);
  static void unstall(usb_device::Pipe pipe);
  static void stall_control();
  static bool take_setup(usb_device::Setup& setup);
  static bool setup_waits();
  static void begin(usb_device::Pipe pipe, std::span<std::uint8_t> bytes);
  static void cancel(usb_device::Pipe pipe);
  static std::uint32_t take_completed();
  static std::size_t moved(usb_device::Pipe pipe);
};
static_assert(usb_device::Controller<UsbController>);

}  // namespace astro::teensy40
