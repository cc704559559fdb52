#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "host/base/byte_source.hpp"

/// The compressions of chunks in bags, and the checksum of MCAP.
namespace astro::bag {

/// One zstd frame with the checksum of its content, which whoever expands it checks.
Bytes compress_zstd(ByteView bytes);

/// Expands a chunk to exactly `size` bytes; `compression` is "" (stored), "lz4" (frame format), "zstd" or, in
/// ROS 1, "bz2". Nothing for any other name, if the bytes are damaged, or if they do not expand to `size`.
/// Allocates `size` bytes only if the compressed bytes can expand to that much: lz4 gains at most a factor
/// 255, zstd 128 KiB per block of 4 bytes, and bz2 46 MB per block, so that the caller's own limit counts.
std::optional<Bytes> expand(std::string_view compression, ByteView bytes, std::uint64_t size);

bool begins_like_zstd(ByteView bytes);

/// Expands one zstd frame that states its size. Nothing if it does not, if that is more than `most_bytes`, or if the
/// bytes are damaged.
std::optional<Bytes> expand_zstd_frame(ByteView bytes, std::uint64_t most_bytes);

enum class Expansion : std::uint8_t { whole, cut, damaged, too_large };

/// Expands a file that is zstd as a whole into `sink`, piece by piece. Whatever the result, what came before the fault
/// was given to the sink, at most `most_bytes`.
Expansion expand_zstd_file(ByteSource& file, std::uint64_t most_bytes,
                           const std::function<void(ByteView)>& sink);

/// CRC-32 of IEEE 802.3 as in zlib; `before` is the checksum of what came before.
std::uint32_t crc32_ieee(ByteView bytes, std::uint32_t before = 0);

}  // namespace astro::bag
