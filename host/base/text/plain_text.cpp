#include "host/base/text/plain_text.hpp"

#include <cstddef>
#include <cstdint>

namespace astro {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

std::uint8_t byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<std::uint8_t>(text[at]) : 0;
}

/// Length of a UTF-8 character by its first byte; 0 for a byte that cannot be the first one.
std::size_t length_from(std::uint8_t first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;  // in bytes; 0: there is no character here
};

/// RFC 3629: the shortest form only, no surrogates, nothing above U+10FFFF.
Character take(std::string_view text) {
  const std::uint8_t first = byte_at(text, 0);
  const std::size_t length = length_from(first);
  if (length < 2) return {first, length};
  std::uint32_t code = first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, i) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte_at(text, i) & 0x3FU);
  }
  const bool too_long = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  if (too_long || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return {};
  return {code, length};
}

bool is_safe(std::uint32_t code) {
  if (code < 0x20) return code == '\n' || code == '\t';
  if (code >= 0x7F && code < 0xA0) return false;                        // DEL and C1
  if (code == 0x61C || code == 0x200E || code == 0x200F) return false;  // marks of direction
  if (code >= 0x2028 && code <= 0x202E) return false;  // separators, embeddings and overrides
  return !(code >= 0x2066 && code <= 0x2069);          // isolates
}

}  // namespace

std::string plain_text(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Character character = take(text);
    const std::size_t length = character.length == 0 ? 1 : character.length;
    out += character.length > 0 && is_safe(character.code) ? text.substr(0, length) : kReplacement;
    text.remove_prefix(length);
  }
  return out;
}

}  // namespace astro
