#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace astro::usb_device {

/// The ports of a board that has USB and a UART: port 0 is USB, port 1 the UART.
template <class Usb, class Uart>
class Ports {
 public:
  static constexpr int kPorts = 2;

  Ports(Usb& usb, Uart& uart) : usb_(usb), uart_(uart) {}

  std::size_t read(int port, std::span<std::uint8_t> into) noexcept {
    return port == kUsb ? usb_.read(into) : uart_.read(into);
  }
  std::size_t write(int port, std::span<const std::uint8_t> bytes) noexcept {
    return port == kUsb ? usb_.write(bytes) : uart_.write(bytes);
  }
  std::size_t room(int port) noexcept { return port == kUsb ? usb_.room() : uart_.room(); }

 private:
  static constexpr int kUsb = 0;

  Usb& usb_;
  Uart& uart_;
};

}  // namespace astro::usb_device
