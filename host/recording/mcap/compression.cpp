#include "host/recording/mcap/compression.hpp"

#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <memory>
#include <stdexcept>

namespace astro::recording {
namespace {

std::optional<Bytes> expand_zstd(ByteView bytes, std::uint64_t size) {
  if (size > (bytes.size() / 4 + 1) * (std::uint64_t{128} << 10)) return std::nullopt;
  Bytes out(static_cast<std::size_t>(size));
  const std::size_t got = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(got) != 0 || got != size) return std::nullopt;
  return out;
}

std::optional<Bytes> expand_lz4(ByteView bytes, std::uint64_t size) {
  if (size > bytes.size() * std::uint64_t{255}) return std::nullopt;
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      raw, &LZ4F_freeDecompressionContext);
  Bytes out(static_cast<std::size_t>(size));
  std::size_t written = 0;
  std::size_t hint = 1;
  while (!bytes.empty() && hint != 0) {
    std::size_t room = out.size() - written;
    std::size_t used = bytes.size();
    hint = LZ4F_decompress(context.get(), out.data() + written, &room, bytes.data(), &used, nullptr);
    if (LZ4F_isError(hint) != 0 || (room == 0 && used == 0)) return std::nullopt;
    written += room;
    bytes = bytes.subspan(used);
  }
  if (hint != 0 || written != size) return std::nullopt;
  return out;
}

}  // namespace

Bytes compress_zstd(ByteView bytes) {
  Bytes out(ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), ZSTD_CLEVEL_DEFAULT);
  if (ZSTD_isError(size) != 0)
    throw std::bad_alloc();  // with a buffer of ZSTD_compressBound() it can only fail for lack of memory
  out.resize(size);
  return out;
}

std::optional<Bytes> expand(std::string_view compression, ByteView bytes, std::uint64_t size) {
  if (compression == "zstd") return expand_zstd(bytes, size);
  if (compression == "lz4") return expand_lz4(bytes, size);
  if (!compression.empty() || bytes.size() != size) return std::nullopt;
  return Bytes(bytes.begin(), bytes.end());
}

std::uint32_t crc32_ieee(ByteView bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(crc32_z(before, bytes.data(), bytes.size()));
}

}  // namespace astro::recording
