#include "host/base/text/columns.hpp"

#include <algorithm>

namespace astro {
namespace {

bool begins_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }

}  // namespace

std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, begins_character));
}

std::string clipped(std::string_view line, std::size_t columns) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (begins_character(line[i]) && characters++ == columns) return std::string(line.substr(0, i));
  return std::string(line);
}

std::string wrapped(std::string_view text, std::size_t columns, std::string_view margin) {
  std::string out, line(margin);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    if (line.size() > margin.size() && columns_of(line) + 1 + columns_of(word) > columns) {
      out += line + '\n';
      line = margin;
    }
    if (line.size() > margin.size()) line += ' ';
    line += word;
    at = end + 1;
  }
  return out + line + '\n';
}

}  // namespace astro
