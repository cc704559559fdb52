#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "hal/interface/board.hpp"
#include "hal/teensy40/arithmetic/identity.hpp"
#include "hal/teensy40/uart.hpp"
#include "hal/teensy40/usb/usb_serial.hpp"
#include "hal/teensy40/watchdog.hpp"

namespace astro::teensy40 {

/// The processor itself.
class System {
 public:
  System(UsbSerial& usb, Uart& uart) : usb_(usb), uart_(uart) {}

  /// Reads the fuses and the cause of the start, and clears the cause in the chip, so that the next start
  /// does not see it.
  void start();

  UniqueId unique_id() noexcept { return id_; }
  std::string_view name() noexcept { return "teensy40"; }
  hal::ResetCause reset_cause() noexcept { return cause_; }

  /// Coasts and restarts. Callable from any context.
  [[noreturn]] void reboot() noexcept;

  /// Coasts, leaves both ports, and starts HalfKay, the Teensy's boot loader; does not return. False if the
  /// Teensy is locked to signed programs, because their loader starts in another way.
  bool enter_bootloader() noexcept;

  /// A host asks a Teensy for its boot loader by setting 134 baud on the USB port.
  bool host_wants_bootloader() noexcept { return usb_.take_bootloader_request(); }

  void feed_watchdog() noexcept { watchdog::feed(); }

 private:
  void leave_ports();

  UsbSerial& usb_;
  Uart& uart_;
  UniqueId id_{};
  hal::ResetCause cause_ = hal::ResetCause::unknown;
};

}  // namespace astro::teensy40
