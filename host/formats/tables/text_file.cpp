#include "host/formats/tables/text_file.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "host/base/files.hpp"
#include "host/formats/files/bag_files.hpp"
#include "host/formats/tables/packed_text.hpp"

namespace astro::tables {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLookedAt = 64;  // bytes

enum class ByteOrder : std::uint8_t { little, big };

/// The byte order of UTF-16, from a mark or from zeros beside characters of ASCII. Nothing if the text is something else.
std::optional<ByteOrder> utf16_order(ByteView text) {
  if (text.size() < 2) return std::nullopt;
  if (text[0] == 0xFF && text[1] == 0xFE) return ByteOrder::little;
  if (text[0] == 0xFE && text[1] == 0xFF) return ByteOrder::big;
  const ByteView begin = text.first(std::min(text.size(), kLookedAt) / 2 * 2);
  std::size_t zeros[2] = {0, 0};
  for (std::size_t i = 0; i < begin.size(); ++i) zeros[i % 2] += begin[i] == 0 ? 1 : 0;
  if (zeros[0] == 0 && zeros[1] == begin.size() / 2) return ByteOrder::little;
  if (zeros[1] == 0 && zeros[0] == begin.size() / 2) return ByteOrder::big;
  return std::nullopt;
}

void append_utf8(Bytes& out, std::uint32_t code) {
  const auto tail = [&](int shift) {
    out.push_back(static_cast<std::uint8_t>(0x80U | ((code >> shift) & 0x3FU)));
  };
  if (code < 0x80) {
    out.push_back(static_cast<std::uint8_t>(code));
  } else if (code < 0x800) {
    out.push_back(static_cast<std::uint8_t>(0xC0U | code >> 6U));
    tail(0);
  } else if (code < 0x10000) {
    out.push_back(static_cast<std::uint8_t>(0xE0U | code >> 12U));
    tail(6);
    tail(0);
  } else {
    out.push_back(static_cast<std::uint8_t>(0xF0U | code >> 18U));
    tail(12);
    tail(6);
    tail(0);
  }
}

/// Halves of pairs that stand alone become the replacement character.
Bytes recoded(ByteView text, ByteOrder order) {
  Bytes out;
  out.reserve(text.size() / 2 + 16);
  const auto unit = [&](std::size_t i) -> std::uint32_t {
    const std::uint32_t first = text[2 * i], second = text[2 * i + 1];
    return order == ByteOrder::little ? first | second << 8U : first << 8U | second;
  };
  const std::size_t units = text.size() / 2;
  for (std::size_t i = 0; i < units; ++i) {
    const std::uint32_t one = unit(i);
    if (i == 0 && one == 0xFEFF) continue;  // the byte order mark
    const bool high = one >= 0xD800 && one < 0xDC00, low = one >= 0xDC00 && one < 0xE000;
    if (high && i + 1 < units && unit(i + 1) >= 0xDC00 && unit(i + 1) < 0xE000) {
      append_utf8(out, 0x10000 + ((one - 0xD800) << 10U) + (unit(++i) - 0xDC00));
    } else {
      append_utf8(out, high || low ? 0xFFFD : one);
    }
  }
  return out;
}

Bytes beginning_of(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return {};
  FileSource file(path);
  const ByteView bytes =
      file.read(0, static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), kLookedAt)));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

Bytes in_utf8(Bytes text) {
  const auto order = utf16_order(text);
  return order ? recoded(text, *order) : std::move(text);
}

Bytes text_of_file(const fs::path& path) {
  bag::require_bag_content(path);
  const Bytes begin = beginning_of(path);
  if (is_gzip(begin)) {
    FileSource file(path);
    return in_utf8(unpacked(file, path.string()));
  }
  return utf16_order(begin) ? in_utf8(load_file(path)) : load_text(path);
}

}  // namespace astro::tables
