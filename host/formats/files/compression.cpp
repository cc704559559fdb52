#include "host/formats/files/compression.hpp"

#include <bzlib.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>

namespace astro::bag {
namespace {

std::optional<Bytes> expand_zstd(ByteView bytes, std::uint64_t size) {
  if (size > (bytes.size() / 4 + 1) * (std::uint64_t{128} << 10)) return std::nullopt;
  // What is no frame, or a single frame that says another size, is refused before memory for the claimed size is filled.
  const std::uint64_t told = bytes.empty() ? 0 : ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (told == ZSTD_CONTENTSIZE_ERROR) return std::nullopt;
  if (told != ZSTD_CONTENTSIZE_UNKNOWN && told != size &&
      ZSTD_findFrameCompressedSize(bytes.data(), bytes.size()) == bytes.size())
    return std::nullopt;
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

std::optional<Bytes> expand_bz2(ByteView bytes, std::uint64_t size) {
  constexpr std::string_view kMagic = "BZh";
  if (!as_text(bytes).starts_with(kMagic) || bytes.size() > std::numeric_limits<unsigned>::max() ||
      size > std::numeric_limits<unsigned>::max())
    return std::nullopt;
  Bytes out(static_cast<std::size_t>(size));
  auto written = static_cast<unsigned>(size);
  // The library reads from a pointer that is not const, but writes nothing there.
  char* const from =
      const_cast<char*>(as_text(bytes).data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  const int result = BZ2_bzBuffToBuffDecompress(reinterpret_cast<char*>(out.data()), &written, from,
                                                static_cast<unsigned>(bytes.size()), 0, 0);
  if (result != BZ_OK || written != size) return std::nullopt;
  return out;
}

}  // namespace

Bytes compress_zstd(ByteView bytes) {
  // Most of a recording are covariances of zeros, which every level packs well: this one needs 0.6 of the default's time and
  // makes files 1.16 times as large.
  constexpr int kLevel = -3;
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  Bytes out(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress2(context.get(), out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0)
    throw std::bad_alloc();  // with a buffer of ZSTD_compressBound() it can only fail for lack of memory
  out.resize(size);
  return out;
}

std::optional<Bytes> expand(std::string_view compression, ByteView bytes, std::uint64_t size) {
  if (compression == "zstd") return expand_zstd(bytes, size);
  if (compression == "lz4") return expand_lz4(bytes, size);
  if (compression == "bz2") return expand_bz2(bytes, size);
  if (!compression.empty() || bytes.size() != size) return std::nullopt;
  return Bytes(bytes.begin(), bytes.end());
}

bool begins_like_zstd(ByteView bytes) {
  constexpr std::uint8_t kMagic[] = {0x28, 0xB5, 0x2F, 0xFD};
  return bytes.size() >= std::size(kMagic) && std::ranges::equal(bytes.first(std::size(kMagic)), kMagic);
}

std::optional<Bytes> expand_zstd_frame(ByteView bytes, std::uint64_t most_bytes) {
  const std::uint64_t size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR || size > most_bytes)
    return std::nullopt;
  return expand("zstd", bytes, size);
}

Expansion expand_zstd_file(ByteSource& file, std::uint64_t most_bytes,
                           const std::function<void(ByteView)>& sink) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  // The window is what the decoder must keep; more than 32 MiB is used by no recorder.
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, 25);
  Bytes piece(std::size_t{1} << 20);
  std::uint64_t written = 0;
  std::size_t hint = 0;
  for (std::uint64_t at = 0; at < file.size();) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), file.size() - at));
    ZSTD_inBuffer in{file.read(at, count).data(), count, 0};
    bool full = true;  // a full piece: the decoder may hold more
    while (in.pos < in.size || full) {
      ZSTD_outBuffer out{piece.data(), piece.size(), 0};
      hint = ZSTD_decompressStream(context.get(), &out, &in);
      if (ZSTD_isError(hint) != 0) return Expansion::damaged;
      written += out.pos;
      if (written > most_bytes) return Expansion::too_large;
      if (out.pos > 0) sink(ByteView(piece).first(out.pos));
      full = out.pos == piece.size() && hint != 0;
    }
    at += count;
  }
  return hint == 0 ? Expansion::whole : Expansion::cut;
}

std::uint32_t crc32_ieee(ByteView bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(crc32_z(before, bytes.data(), bytes.size()));
}

}  // namespace astro::bag
