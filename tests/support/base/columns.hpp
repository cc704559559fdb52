#pragma once

#include <algorithm>
#include <string_view>

#include "host/base/text/columns.hpp"

namespace astro::support {

/// The columns of the longest line.
inline std::size_t widest_line(std::string_view text) {
  std::size_t widest = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    widest = std::max(widest, columns_of(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return widest;
}

}  // namespace astro::support
