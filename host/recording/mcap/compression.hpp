#pragma once

#include <optional>
#include <string_view>

#include "host/base/bytes.hpp"

/// The compressions of MCAP chunks, and the checksum of MCAP.
namespace astro::recording {

/// One zstd frame at level 3, the library's own choice.
Bytes compress_zstd(ByteView bytes);

/// Expands a chunk to exactly `size` bytes; `compression` is "" (stored), "lz4" (frame format) or "zstd".
/// Nothing for any other name, if the bytes are damaged, or if they do not expand to `size`. Allocates `size`
/// bytes only if the compressed bytes can expand to that much: lz4 gains at most a factor 255, zstd 128 KiB
/// per block of 4 bytes.
std::optional<Bytes> expand(std::string_view compression, ByteView bytes, std::uint64_t size);

/// CRC-32 of IEEE 802.3 as in zlib; `before` is the checksum of what came before.
std::uint32_t crc32_ieee(ByteView bytes, std::uint32_t before = 0);

}  // namespace astro::recording
