#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// UTF-8 text on lines of limited width. Each character counts as one column.
namespace astro {

std::size_t columns_of(std::string_view text);

/// The first `columns` characters.
std::string clipped(std::string_view line, std::size_t columns);

inline constexpr std::size_t kTextColumns = 80;

/// `text` broken at its blanks so that no line is longer than `columns`, unless a single word is. Every line begins with
/// `margin` and ends with a newline.
std::string wrapped(std::string_view text, std::size_t columns = kTextColumns, std::string_view margin = {});

}  // namespace astro
