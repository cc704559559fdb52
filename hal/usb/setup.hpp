#pragma once

#include <cstdint>

namespace astro::usb_device {

/// The eight bytes of a SETUP packet (USB 2.0, table 9-2).
struct Setup {
  std::uint8_t type = 0, request = 0;
  std::uint16_t value = 0, index = 0, length = 0;

  constexpr bool to_host() const { return (type & 0x80) != 0; }
  friend constexpr bool operator==(const Setup&, const Setup&) = default;
};

/// From the packet's words, the first byte lowest.
constexpr Setup make_setup(std::uint32_t first, std::uint32_t second) {
  return {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(first >> 8),
          static_cast<std::uint16_t>(first >> 16), static_cast<std::uint16_t>(second),
          static_cast<std::uint16_t>(second >> 16)};
}

}  // namespace astro::usb_device
