#pragma once

#include "hal/rp2040/clock.hpp"
#include "hal/rp2040/core/interrupts.hpp"
#include "hal/usb/controller.hpp"

namespace astro::rp2040 {

/// The USB device controller at register level, as hal/usb/controller.hpp describes it. It knows packets only: the driver
/// divides transfers into them and keeps the data toggles.
///
/// Cost  an interrupt for each packet: some 4 us for 64 bytes. cancel(), stall() and what drops transfers wait 70 us if a packet
///       lies ready for the host.
struct UsbController {
  /// A Raspberry Pi Pico's serial port, as programs for it have one.
  static constexpr usb_device::Identity kIdentity{0x2E8A, 0x000A, 0x0100, usb_device::Speed::full};
  static constexpr std::uint32_t kBootloaderBaud = 1200;

  struct InterruptOff : rp2040::InterruptOff {
    InterruptOff() : rp2040::InterruptOff(irq::kUsb) {}
  };
  static void install(void (*handler)()) { rp2040::install(irq::kUsb, urgency::kUsb, handler); }
  static std::uint64_t now_us() { return Clock().now_us(); }

  static void power_down();
  static void start();
  static void detach() { power_down(); }
  static usb_device::Events take_events();
  static bool clean_up_after_reset();
  static usb_device::Speed speed() { return usb_device::Speed::full; }
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

}  // namespace astro::rp2040
