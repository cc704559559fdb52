#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/byte_ring.hpp"

namespace astro::rp2040 {

/// The serial port on GP0 and GP1: UART0, 8N1, no flow control, 1 Mbit/s, which the system clock makes exactly.
///
/// Errors  bytes that arrive faster than they are read are dropped, and damaged characters are passed on: the protocol's
///         CRC detects and counts both.
/// Cost    an interrupt for every 16 bytes or for a pause of three. The queues of 32 bytes last for 320 us, longer than a
///         tick.
class Uart {
 public:
  /// A program has one such port: the interrupt uses the object that was started last.
  void start();

  // Main loop only; none blocks.
  std::size_t read(std::span<std::uint8_t> into) noexcept { return received_.pop(into); }
  std::size_t write(std::span<const std::uint8_t> bytes) noexcept;
  std::size_t room() const noexcept { return to_send_.room(); }

 private:
  static void interrupt();
  void receive();
  void send();

  ByteRing<1024> received_;
  ByteRing<1024> to_send_;  // 10 ms on the line; a longer queue would delay answers
};

}  // namespace astro::rp2040
