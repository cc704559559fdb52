#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
namespace astro::teensy40 {
class UsbSerial {
 public:
  void start(std::string_view) {}
  void interrupt() {}
  void detach() {}
  std::size_t read(std::span<std::uint8_t>) noexcept { return 0; }
  std::size_t write(std::span<const std::uint8_t>) noexcept { return 0; }
  std::size_t room() const noexcept { return 0; }
  bool bootloader_requested() const noexcept { return false; }
};
}  // namespace astro::teensy40
