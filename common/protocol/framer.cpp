#include "common/protocol/framer.hpp"

#include <algorithm>

#include "common/base/crc32.hpp"
#include "common/base/little_endian.hpp"

namespace astro::protocol {

std::size_t encode_frame(std::span<const std::uint8_t> body,
                         std::span<std::uint8_t, kMaxFrame> out) noexcept {
  if (body.size() < kHeaderSize || body.size() > kMaxBody) return 0;
  std::array<std::uint8_t, kMaxBody + kCrcSize> plain;
  auto* const end = std::copy(body.begin(), body.end(), plain.data());
  store_little_endian(end, crc32(body));
  const auto code = cobs::encode(std::span(plain).first(body.size() + kCrcSize), out);
  out[*code] = 0;
  return *code + 1;
}

std::optional<std::span<const std::uint8_t>> Framer::finish() noexcept {
  const std::size_t received = size_;
  size_ = 0;
  const auto drop = [](std::uint32_t& count) {
    ++count;
    return std::nullopt;
  };
  if (received == 0) return std::nullopt;
  if (received > code_.size()) return drop(counts_.oversize);
  const auto plain = cobs::decode(std::span(code_).first(received), code_);
  if (!plain) return drop(counts_.bad_cobs);
  if (*plain < kHeaderSize + kCrcSize) return drop(counts_.undersize);
  const std::size_t body_size = *plain - kCrcSize;
  if (body_size > kMaxBody) return drop(counts_.oversize);
  const auto body = std::span<const std::uint8_t>(code_).first(body_size);
  const auto sent = load_little_endian<std::uint32_t>(code_.data() + body_size);
  if (sent != crc32(body)) return drop(counts_.bad_crc);
  ++counts_.good;
  return body;
}

}  // namespace astro::protocol
