#include "host/base/text/json_weight.hpp"

#include <cstddef>

namespace astro {
namespace {

// Memory that nlohmann-json and the heap take: for a value in an array that grows by doubling, for an array
// or object with its block of memory, for a member of an object with its key, for a string.
constexpr std::size_t kValueBytes = 32, kContainerBytes = 64, kMemberBytes = 96, kStringBytes = 64;
constexpr int kMostJsonLevels = 100;
constexpr std::size_t kFreeJsonBytes = std::size_t{40} << 20;

std::size_t bytes_behind(char c) {
  switch (c) {
    case ',':
      return kValueBytes;
    case ':':
      return kMemberBytes;
    case '[':
    case '{':
      return kContainerBytes;
    default:
      return 0;
  }
}

}  // namespace

bool json_fits_memory(std::string_view text) {
  std::size_t bytes = 0;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      in_string = !in_string;
      if (in_string) bytes += kStringBytes;
    }
    if (in_string && text[i] == '\\') ++i;  // an escaped quote does not end the string
    if (in_string) continue;
    bytes += bytes_behind(text[i]);
    depth += text[i] == '[' || text[i] == '{' ? 1 : text[i] == ']' || text[i] == '}' ? -1 : 0;
    if (depth > kMostJsonLevels) return false;
  }
  return bytes <= kFreeJsonBytes + 2 * text.size();
}

}  // namespace astro
