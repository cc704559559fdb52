#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/protocol/body.hpp"
#include "common/protocol/cobs.hpp"

/// Converts bodies to frames and back. A frame is COBS(body, CRC-32 of the body, little-endian) and one 0x00.
namespace astro::protocol {

inline constexpr std::size_t kCrcSize = 4;
/// The size of the largest frame of a body of this size, with its 0x00.
constexpr std::size_t largest_frame_of(std::size_t body) {
  return cobs::max_encoded_size(body + kCrcSize) + 1;
}
inline constexpr std::size_t kMaxFrame = largest_frame_of(kMaxBody);

/// Writes the frame of `body`, with its 0x00, and returns its size; 0 if the body has more than kMaxBody or
/// fewer than kHeaderSize bytes.
std::size_t encode_frame(std::span<const std::uint8_t> body, std::span<std::uint8_t, kMaxFrame> out) noexcept;

/// Numbers of received frames; each wraps at 2^32. A 0x00 between frames does not count.
struct FrameCounts {
  std::uint32_t good = 0;
  std::uint32_t bad_crc = 0;
  std::uint32_t bad_cobs = 0;
  std::uint32_t oversize = 0;   // the body would exceed kMaxBody
  std::uint32_t undersize = 0;  // too small for a header
  constexpr std::uint32_t bad() const { return bad_crc + bad_cobs + oversize + undersize; }
};

/// Receives a byte stream from any point on. A damaged frame is counted and dropped, and the next 0x00 starts
/// a new one. No input makes it read or write outside its buffer.
///
/// Cost    a compare and a store per byte; decoding and CRC at each 0x00, at most kMaxFrame bytes. Main loop.
class Framer {
 public:
  /// Returns the body that this byte completes, if any; it is valid until the next push. A copy of a Framer
  /// also has the frame that is being received.
  std::optional<std::span<const std::uint8_t>> push(std::uint8_t byte) noexcept {
    if (byte == 0) return finish();
    if (size_ < code_.size()) code_[size_] = byte;
    size_ += size_ <= code_.size() ? 1 : 0;
    return std::nullopt;
  }

  const FrameCounts& counts() const noexcept { return counts_; }

 private:
  std::optional<std::span<const std::uint8_t>> finish() noexcept;

  std::array<std::uint8_t, kMaxFrame - 1> code_{};  // decoded in place
  std::size_t size_ = 0;                            // kMaxFrame: the frame is too large
  FrameCounts counts_;
};

}  // namespace astro::protocol
