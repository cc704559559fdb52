#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/protocol/codec.hpp"
#include "common/protocol/framer.hpp"

namespace astro::protocol {

/// All bytes of a message's frame, with the 0x00 at its end. Small enough for the stack.
class Frame {
 public:
  template <Message M>
  Frame(const M& message, std::uint16_t request_id) noexcept {
    std::array<std::uint8_t, kMaxBody> body;
    size_ = encode_frame(std::span(body).first(encode(message, request_id, body)), bytes_);
  }

  std::span<const std::uint8_t> bytes() const noexcept { return std::span(bytes_).first(size_); }

 private:
  std::array<std::uint8_t, kMaxFrame> bytes_{};
  std::size_t size_ = 0;
};

}  // namespace astro::protocol
