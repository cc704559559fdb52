#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/params/parameter_set.hpp"

namespace astro {

/// One parameter set as it is stored in flash. All numbers are little-endian:
///
///   0   4   magic "ASTP"
///   4   1   format version, 1
///   5   1   0
///   6   2   payload bytes
///   8   4   sequence number, larger than the previous record's; wraps at 2^32
///   12  n   payload: rows of {id, 2 bytes; size, 1 byte; value, `size` bytes}, in any order
///   ..  4   CRC-32 of everything before it
///
/// A number is a 4-byte raw value, a text is 24 bytes padded with NUL. Rows describe themselves, so firmware
/// can read the records of older and newer firmware: missing rows get their defaults; rows with unknown ids
/// are kept unchanged when the set is rewritten.
///
/// Cost    the buffer, 1 KiB; no heap.
class Record {
 public:
  static constexpr std::size_t kMaxBytes = 1024;
  static constexpr std::size_t kHeaderBytes = 12;
  static constexpr std::size_t kCrcBytes = 4;

  /// The size of the record that begins with these bytes, or 0 if none does. Needs kHeaderBytes.
  static std::size_t announced_bytes(std::span<const std::uint8_t> header);
  static bool has_magic(std::span<const std::uint8_t> bytes);
  /// The sequence number that the header claims; wrong if the record is damaged. Needs kHeaderBytes.
  /// Precondition: has_magic().
  static std::uint32_t announced_sequence(std::span<const std::uint8_t> header);

  /// Drops the present content and returns room for `size` bytes, at most kMaxBytes, which the caller fills.
  std::span<std::uint8_t> room(std::size_t size);

  /// The bytes in room() are a whole, undamaged record whose rows can be read.
  bool intact() const;

  /// Precondition: intact().
  std::uint32_t sequence() const;
  ParameterSet set() const;

  /// Becomes the record of `set`. If the present content is intact, its unknown rows are kept. False if they
  /// leave too little room; the content is then no record.
  bool rewrite(const ParameterSet& set, std::uint32_t sequence);

  std::size_t size() const { return size_; }

  /// The record, padded with 0xFF to `padded_size` bytes: size() to kMaxBytes.
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
