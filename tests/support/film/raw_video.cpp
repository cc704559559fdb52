#include "tests/support/film/raw_video.hpp"

#include <cmath>
#include <initializer_list>
#include <string_view>

namespace astro::support::film {
namespace {

void append_big_endian(Bytes& bytes, std::uint64_t value, int count) {
  for (int byte = count - 1; byte >= 0; --byte)
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
}

/// Ids carry their own length: 1A45DFA3 has four bytes.
void append_id(Bytes& bytes, std::uint32_t id) {
  append_big_endian(bytes, id, id > 0xFFFFFF ? 4 : id > 0xFFFF ? 3 : id > 0xFF ? 2 : 1);
}

/// Always eight bytes long.
void append_size(Bytes& bytes, std::uint64_t size) {
  append_big_endian(bytes, (std::uint64_t{1} << 56) | size, 8);
}
constexpr std::uint64_t kUnknownSize = (std::uint64_t{1} << 56) - 1;

Bytes element(std::uint32_t id, ByteView content) {
  Bytes bytes;
  append_id(bytes, id);
  append_size(bytes, content.size());
  append(bytes, content);
  return bytes;
}

Bytes number(std::uint32_t id, std::uint64_t value) {
  Bytes content;
  append_big_endian(content, value, 8);
  return element(id, content);
}

Bytes text(std::uint32_t id, std::string_view words) { return element(id, as_bytes(words)); }

Bytes master(std::uint32_t id, std::initializer_list<Bytes> children) {
  Bytes content;
  for (const Bytes& child : children) append(content, child);
  return element(id, content);
}

}  // namespace

Bytes raw_video_header(int width_px, int height_px, double fps) {
  Bytes bytes =
      master(0x1A45DFA3, {number(0x4286, 1), number(0x42F7, 1), number(0x42F2, 4), number(0x42F3, 8),
                          text(0x4282, "matroska"), number(0x4287, 4), number(0x4285, 2)});
  append_id(bytes, 0x18538067);  // the segment, which has no end
  append_size(bytes, kUnknownSize);
  append(bytes, master(0x1549A966, {number(0x2AD7B1, 1000), text(0x4D80, "tests"), text(0x5741, "tests")}));
  const auto interval_ns = static_cast<std::uint64_t>(std::llround(1e9 / fps));
  const Bytes video =
      master(0xE0, {number(0xB0, static_cast<std::uint64_t>(width_px)),
                    number(0xBA, static_cast<std::uint64_t>(height_px)), text(0x2EB524, "I420")});
  append(bytes, master(0x1654AE6B,
                       {master(0xAE, {number(0xD7, 1), number(0x73C5, 1), number(0x83, 1),
                                      number(0x23E383, interval_ns), text(0x86, "V_UNCOMPRESSED"), video})}));
  return bytes;
}

Bytes raw_video_frame_header(std::int64_t pts_us, std::size_t picture_bytes) {
  // A cluster for each picture, because a block's own stamp has only 16 bits.
  const Bytes stamp = number(0xE7, static_cast<std::uint64_t>(pts_us));
  constexpr std::uint8_t kBlock[] = {0x81, 0, 0, 0x80};  // track 1, at the cluster's stamp, a key frame
  Bytes block;
  append_id(block, 0xA3);
  append_size(block, sizeof kBlock + picture_bytes);
  append(block, ByteView(kBlock));
  Bytes bytes;
  append_id(bytes, 0x1F43B675);
  append_size(bytes, stamp.size() + block.size() + picture_bytes);
  append(bytes, stamp);
  append(bytes, block);
  return bytes;
}

}  // namespace astro::support::film
