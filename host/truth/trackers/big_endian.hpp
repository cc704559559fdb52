#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "host/base/bytes.hpp"

/// Numbers as VRPN sends them: the most significant byte first.
namespace astro::truth::vrpn {

/// The number at an offset of bytes that are known to be long enough.
template <Number T>
T load_big(ByteView bytes, std::size_t offset) {
  std::array<std::uint8_t, sizeof(T)> raw;  // NOLINT(cppcoreguidelines-pro-type-member-init): copy_n fills it
  std::copy_n(bytes.subspan(offset, sizeof(T)).rbegin(), sizeof(T), raw.begin());
  return std::bit_cast<T>(raw);
}

template <Number T>
void append_big(Bytes& bytes, T value) {
  const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
  bytes.insert(bytes.end(), raw.rbegin(), raw.rend());
}

}  // namespace astro::truth::vrpn
