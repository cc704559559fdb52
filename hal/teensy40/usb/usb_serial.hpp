#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/base/byte_ring.hpp"
#include "hal/teensy40/usb/control.hpp"
#include "hal/teensy40/usb/controller.hpp"

namespace astro::teensy40 {

/// The robot as a serial port on USB.
///
/// Bytes that are written while no program has the port open are dropped, because the next program must not
/// get them; so are bytes that are written while the bus is suspended or the cable is out. Bytes from a host
/// are taken when there is room; until then the host waits.
///
/// Cost    an interrupt of some microseconds for each packet; 2 KB.
class UsbSerial {
 public:
  /// A program has one of them. `serial_number` must outlive it. Stays off the bus for 0.3 s after every
  /// start, so that the host notices that the program before, the boot loader or the ROM has left. read()
  /// attaches it again.
  void start(std::string_view serial_number);

  // Main loop only, which must call read() regularly; none blocks.
  std::size_t read(std::span<std::uint8_t> into) noexcept;
  std::size_t write(std::span<const std::uint8_t> bytes) noexcept;
  std::size_t room() const noexcept;

  /// True once for each time that a host sets 134 baud, which asks a Teensy for its boot loader.
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
  ByteRing<1024> to_send_;
  std::array<std::uint8_t, 512> sending_{}, received_{};
  std::array<std::uint8_t, 8> control_data_{};
  volatile bool busy_ = false;
  volatile std::size_t received_size_ = 0;
  std::size_t received_taken_ = 0;
  bool status_stage_ = true;
  volatile bool asleep_ = false, bootloader_requested_ = false;
  volatile bool away_ = false;  // has left the bus, so that the host forgets the device
  std::uint64_t left_at_us_ = 0;
};

}  // namespace astro::teensy40
