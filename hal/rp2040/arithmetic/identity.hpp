#pragma once

#include <array>
#include <cstdint>

namespace astro::rp2040 {

using UniqueId = std::array<std::uint8_t, 16>;

/// The chip itself has no number, its flash has one of 64 bits. The rest is zero.
constexpr UniqueId unique_id(const std::array<std::uint8_t, 8>& of_flash) {
  UniqueId id{};
  for (std::size_t i = 0; i < of_flash.size(); ++i) id[i] = of_flash[i];
  return id;
}

}  // namespace astro::rp2040
