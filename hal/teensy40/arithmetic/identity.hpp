#pragma once

#include <array>
#include <cstdint>

namespace astro::teensy40 {

using UniqueId = std::array<std::uint8_t, 16>;

/// The chip's fuse words as bytes, the first word's lowest byte first.
constexpr UniqueId unique_id(const std::array<std::uint32_t, 4>& fuses) {
  UniqueId id{};
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = static_cast<std::uint8_t>(fuses[i / 4] >> (i % 4 * 8));
  return id;
}

/// The id as USB shows it: 32 hexadecimal digits.
constexpr std::array<char, 32> serial_number(const UniqueId& id) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::array<char, 32> text{};
  for (std::size_t i = 0; i < id.size(); ++i) {
    text[2 * i] = kDigits[id[i] >> 4];
    text[2 * i + 1] = kDigits[id[i] & 15];
  }
  return text;
}

}  // namespace astro::teensy40
