#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/base/result.hpp"

/// Consistent overhead byte stuffing: encodes any bytes without zeros, so that a zero can end a frame. Each
/// block is a code byte n and n - 1 data bytes; n < 255 means that a zero follows them, except at the end of
/// the data.
///
/// Source  Cheshire and Baker, "Consistent Overhead Byte Stuffing", IEEE/ACM Transactions on Networking 7(2),
///         1999
namespace astro::cobs {

enum class Error : std::uint8_t {
  no_room,      // `out` is too small; decode may have filled it
  empty,        // an encoding has at least one byte
  zero_inside,  // an encoding contains no zero
  cut_short,    // the last block announces more bytes than there are
};

constexpr std::string_view name(Error error) {
  constexpr std::string_view kNames[] = {"no_room", "empty", "zero_inside", "cut_short"};
  return kNames[static_cast<std::size_t>(error)];
}

/// The largest size of the encoding of `size` bytes, without the zero at its end.
constexpr std::size_t max_encoded_size(std::size_t size) { return size == 0 ? 1 : size + (size + 253) / 254; }

/// Encodes `data` into `out`, which needs room for max_encoded_size(data.size()), and returns the number of
/// bytes written, at least 1. Never writes a zero. The spans must not overlap.
constexpr Result<std::size_t, Error> encode(std::span<const std::uint8_t> data, std::span<std::uint8_t> out) {
  if (out.size() < max_encoded_size(data.size())) return Error::no_room;
  std::size_t code_at = 0;
  std::size_t end = 1;
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (data[i] != 0) {
      out[end++] = data[i];
      const bool full = end - code_at == 0xFF;
      if (!full || i + 1 == data.size()) continue;
    }
    out[code_at] = static_cast<std::uint8_t>(end - code_at);
    code_at = end++;
  }
  out[code_at] = static_cast<std::uint8_t>(end - code_at);
  return end;
}

/// Decodes a whole encoding (without the zero at its end) into `out` and returns the number of bytes written,
/// which is less than code.size(). `out` may begin where `code` begins. Also accepts a superfluous last block
/// 0x01 after a full one, which some encoders write.
constexpr Result<std::size_t, Error> decode(std::span<const std::uint8_t> code, std::span<std::uint8_t> out) {
  if (code.empty()) return Error::empty;
  std::size_t end = 0;
  for (std::size_t at = 0; at < code.size();) {
    const std::size_t block = code[at];
    if (block == 0) return Error::zero_inside;
    if (block > code.size() - at) return Error::cut_short;
    const bool zero_follows = block != 0xFF && at + block < code.size();
    if (out.size() - end < block - 1 + (zero_follows ? 1 : 0)) return Error::no_room;
    for (std::size_t i = 1; i < block; ++i) {
      if (code[at + i] == 0) return Error::zero_inside;
      out[end++] = code[at + i];
    }
    if (zero_follows) out[end++] = 0;
    at += block;
  }
  return end;
}

}  // namespace astro::cobs
