#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/byte_ring.hpp"
#include "hal/teensy40/arithmetic/uart_divider.hpp"

namespace astro::teensy40 {

/// The serial port on pins 0 and 1: LPUART6, 8N1, no flow control, 1 Mbit/s, which both 24 MHz and the usual
/// USB adapters can make exactly.
///
/// Errors  bytes that arrive faster than they are read are dropped, and damaged characters are passed on: the
///         protocol's CRC detects and counts both.
/// Cost    an interrupt of about a microsecond every other byte.
class Uart {
 public:
  static constexpr std::uint32_t kBaud = 1'000'000;

  /// A program has one such port: the interrupt uses the object that was started last.
  void start();

  // Main loop only; none blocks.
  std::size_t read(std::span<std::uint8_t> into) noexcept { return received_.pop(into); }
  std::size_t write(std::span<const std::uint8_t> bytes) noexcept;
  /// Ends receiving and sending.
  void stop() noexcept;
  std::size_t room() const noexcept { return to_send_.room(); }

 private:
  static void interrupt();
  void receive(std::uint32_t status);
  void send();

  static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "the queues need no lock");
  ByteRing<1024> received_;
  ByteRing<1024> to_send_;  // 10 ms on the line; a longer queue would delay answers
};

}  // namespace astro::teensy40
