#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/params/parameter_set.hpp"

namespace astro {

/// One parameter set as it lies in flash. All numbers little-endian:
///
///   0   4   magic "ASTP"
///   4   1   format version, 1
///   5   1   0
///   6   2   payload bytes
///   8   4   sequence number, one more than the record before, wraps at 2^32
///   12  n   payload: rows of {id, 2 bytes; size, 1 byte; value, `size` bytes}, in any order
///   ..  4   CRC-32 of everything before it
///
/// A number is a 4-byte raw value, a text 24 bytes padded with NUL. Rows describe themselves, so firmware
/// reads the records of older and newer firmware: rows that are missing take their defaults, rows with
/// unknown ids are kept as they are when the set is rewritten.
///
/// Cost    the buffer, 1 KiB; no heap.
class Record {
 public:
  static constexpr std::size_t kMaxBytes = 1024;
  static constexpr std::size_t kHeaderBytes = 12;
  static constexpr std::size_t kCrcBytes = 4;

  /// Size of the record that these bytes begin, or 0 if none begins here. Needs kHeaderBytes.
  static std::size_t announced_bytes(std::span<const std::uint8_t> header);
  static bool has_magic(std::span<const std::uint8_t> bytes);
  /// What it says of its age, if has_magic(): a damaged one may lie. Needs kHeaderBytes.
  static std::uint32_t announced_sequence(std::span<const std::uint8_t> header);

  /// Forgets what it held and gives room for the `size` <= kMaxBytes bytes of a record, to be filled by the
  /// caller.
  std::span<std::uint8_t> room(std::size_t size);

  /// The bytes in room() are one whole record, undamaged and with rows that can be read.
  bool intact() const;

  /// Only when intact().
  std::uint32_t sequence() const;
  ParameterSet set() const;

  /// Becomes the record of `set`. Keeps the unknown rows of an intact record, none of any other.
  /// False, and no record any more, if the unknown rows leave too little room.
  bool rewrite(const ParameterSet& set, std::uint32_t sequence);

  std::size_t size() const { return size_; }

  /// The record and the 0xFF after it, `padded_size` >= size() bytes of at most kMaxBytes.
  std::span<const std::uint8_t> bytes(std::size_t padded_size) const {
    return std::span(bytes_).first(padded_size);
  }

 private:
  std::span<const std::uint8_t> payload() const;
  std::size_t keep_unknown_rows();
  void close(std::size_t payload_bytes, std::uint32_t sequence);

  std::array<std::uint8_t, kMaxBytes> bytes_{};
  std::size_t size_ = 0;
};

}  // namespace astro
