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

}  // namespace astro::teensy40
