#pragma once

#include <algorithm>
#include <string>

namespace astro::commands {

/// Columns that a line of UTF-8 takes, if each character takes one.
inline std::size_t width(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

inline std::size_t widest_line(const std::string& text) {
  std::size_t widest = 0;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    widest = std::max(widest, width(text.substr(begin, end - begin)));
  return widest;
}

}  // namespace astro::commands
