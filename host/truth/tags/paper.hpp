#pragma once

#include <optional>
#include <string_view>

namespace astro::truth::tags {

/// A sheet of paper, upright.
struct Paper {
  std::string_view name;
  double width_mm, height_mm;
};

inline constexpr Paper kA4{"a4", 210, 297};
inline constexpr Paper kLetter{"letter", 215.9, 279.4};

/// Nothing for any other name.
std::optional<Paper> paper_named(std::string_view name);

}  // namespace astro::truth::tags
