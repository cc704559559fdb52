#pragma once

#include <fmt/format.h>

#include <string>

/// Numbers as people read them.
namespace astro {

/// `value`, or 0 if it would be shown with so many decimals as "-0.00": a minus sign before nothing but zeros
/// says that something is wrong where nothing is. Compares what is printed, so that ties round as fmt rounds
/// them.
inline double without_minus_zero(double value, int decimals) {
  if (!(value < 0) && value != 0) return value;
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_of("123456789in") == std::string::npos ? 0.0 : value;  // "inf" and "nan" stay
}

}  // namespace astro
