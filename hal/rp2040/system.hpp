#pragma once

#include <string_view>

#include "hal/interface/board.hpp"
#include "hal/rp2040/arithmetic/identity.hpp"
#include "hal/rp2040/usb/usb_serial.hpp"
#include "hal/rp2040/watchdog.hpp"

namespace astro::rp2040 {

/// The processor itself.
class System {
 public:
  explicit System(UsbSerial& usb) : usb_(usb) {}

  /// Reads the flash's number and the cause of the start.
  void start();

  UniqueId unique_id() noexcept { return id_; }
  std::string_view name() noexcept { return "rp2040"; }
  hal::ResetCause reset_cause() noexcept { return cause_; }

  /// Coasts and restarts. Callable from any context.
  [[noreturn]] void reboot() noexcept;

  /// Coasts, leaves USB and starts the boot ROM's loader, which shows itself as a drive named RPI-RP2; does not return. False if the ROM
  /// has no such function.
  bool enter_bootloader() noexcept;

  /// A host asks a Pico for its boot loader by setting 1200 baud on the USB port.
  bool host_wants_bootloader() noexcept { return usb_.take_bootloader_request(); }

  void feed_watchdog() noexcept { watchdog_timer::feed(); }

 private:
  UsbSerial& usb_;
  UniqueId id_{};
  hal::ResetCause cause_ = hal::ResetCause::unknown;
};

}  // namespace astro::rp2040
