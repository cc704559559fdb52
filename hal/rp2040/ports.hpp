#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/rp2040/uart.hpp"

namespace astro::rp2040 {

/// The serial port on GP0 and GP1.
class Ports {
 public:
  static constexpr int kPorts = 1;

  explicit Ports(Uart& uart) : uart_(uart) {}

  std::size_t read(int, std::span<std::uint8_t> into) noexcept { return uart_.read(into); }
  std::size_t write(int, std::span<const std::uint8_t> bytes) noexcept { return uart_.write(bytes); }
  std::size_t room(int) noexcept { return uart_.room(); }

 private:
  Uart& uart_;
};

}  // namespace astro::rp2040
