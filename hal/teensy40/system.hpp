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

  /// Reads the fuses and why the chip started, and forgets the latter in the chip, so that the next start
  /// tells of itself.
  void start();

  UniqueId unique_id() noexcept { return id_; }
  std::string_view name() noexcept { return "teensy40"; }
  hal::ResetCause reset_cause() noexcept { return cause_; }

  /// Coasts and restarts. Any context.
  [[noreturn]] void reboot() noexcept;

  /// Coasts, leaves both ports, and gives the processor to HalfKay, the Teensy's boot loader; does not
  /// return. False: the Teensy is locked to signed programs, whose loader is entered in another way.
  bool enter_bootloader() noexcept;

  /// 134 baud on the USB port is how a Teensy is asked.
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
