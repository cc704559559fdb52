#pragma once

#include <fmt/format.h>

#include <string>

/// Numbers as people read them.
namespace astro {

/// `value`, or 0 if with this many decimals it would be printed as "-0.00": a minus sign before zeros looks
/// like an error. Compares the printed text, so that ties round as fmt rounds them.
inline double without_minus_zero(double value, int decimals) {
  if (!(value < 0) && value != 0) return value;
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_of("123456789in") == std::string::npos ? 0.0 : value;  // "inf" and "nan" stay
}

}  // namespace astro
