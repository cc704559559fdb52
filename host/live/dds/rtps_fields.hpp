#pragma once

#include <bit>

#include "host/base/bytes.hpp"

namespace astro::dds {

/// Fields of RTPS one after the other, in the byte order that their submessage or payload states. As with ByteCursor, a read
/// past the end gives zero and makes ok() false.
class RtpsFields {
 public:
  RtpsFields(ByteView bytes, std::endian order)
      : bytes_(bytes), cursor_(bytes), swapped_(order != std::endian::native) {}

  bool ok() const { return cursor_.ok(); }
  std::endian order() const { return swapped_ ? std::endian::big : std::endian::little; }
  std::size_t offset() const { return cursor_.offset(); }
  ByteView take(std::size_t size) { return cursor_.take(size); }
  /// All that has not been read.
  ByteView rest() const { return ok() ? bytes_.subspan(cursor_.offset()) : ByteView(); }

  std::uint16_t u16() {
    const auto value = cursor_.number<std::uint16_t>();
    return swapped_ ? static_cast<std::uint16_t>(value >> 8 | value << 8) : value;
  }
  std::uint32_t u32() {
    const auto value = cursor_.number<std::uint32_t>();
    return swapped_ ? __builtin_bswap32(value) : value;
  }
  /// A sequence number: the upper half comes first, whatever the byte order.
  std::int64_t sequence_number() {
    const std::uint64_t upper = u32();
    return static_cast<std::int64_t>(upper << 32 | u32());
  }
  /// Skips to the next multiple of four, counted from the first byte.
  void align() { take((4 - cursor_.offset() % 4) % 4); }

 private:
  ByteView bytes_;
  ByteCursor cursor_;
  bool swapped_;
};

}  // namespace astro::dds
