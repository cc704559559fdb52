#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/teensy40/arithmetic/ring.hpp"
#include "hal/teensy40/usb/control.hpp"
#include "hal/teensy40/usb/controller.hpp"

namespace astro::teensy40 {

/// The robot as a serial port on USB.
///
/// What is written while no program has the port open is dropped: the next one must not get it, and nobody
/// waits for it. The same while the bus sleeps or the cable is out. What a host sends is taken when there is
/// room; until then the host waits.
///
/// Cost    an interrupt of some microseconds for each packet; 2 KB.
class UsbSerial {
 public:
  /// One in a program. `serial_number` outlives it. Stays off the bus for 0.3 s, whatever the reason of the
  /// start: the program before, the boot loader or the ROM may have been attached, and the host must forget
  /// it. Comes back in read().
  void start(std::string_view serial_number);

  // Main loop only, which reads every now and then; none blocks.
  std::size_t read(std::span<std::uint8_t> into) noexcept;
  std::size_t write(std::span<const std::uint8_t> bytes) noexcept;
  std::size_t room() const noexcept;

  /// True once for each time that a host sets 134 baud: a Teensy is asked for its boot loader that way.
  bool take_bootloader_request() noexcept;
  /// Leaves the bus for good.
  void detach() noexcept;

 private:
  static void interrupt();
  void handle();
  void reset();
  void handle_setup(const usb_device::Setup& setup);
  void stay_away();
  void come_back_in_time();
  void drop_output();
  void carry_out(const usb_device::Control::Changes& changes);
  void complete(std::uint32_t pipes);
  void send_next();
  void listen();

  usb_device::Control control_;
  Ring<1024> to_send_;
  std::array<std::uint8_t, 512> sending_{}, received_{};
  std::array<std::uint8_t, 8> control_data_{};
  volatile bool busy_ = false;
  volatile std::size_t received_size_ = 0;
  std::size_t received_taken_ = 0;
  bool status_stage_ = true;
  volatile bool asleep_ = false, bootloader_requested_ = false;
  volatile bool away_ = false;  // left the bus, so that the host forgets what it knew
  std::uint64_t left_at_us_ = 0;
};

}  // namespace astro::teensy40
