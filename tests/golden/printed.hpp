#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

/// Comparison with a number as it is printed in a table.
namespace astro::golden {

/// Half a unit of the last digit of `printed`: what printing may have taken away.
inline double half_last_digit(const std::string& printed) {
  const std::size_t point = printed.find('.');
  const std::size_t decimals = point == std::string::npos ? 0 : printed.size() - point - 1;
  return 0.5 * std::pow(10.0, -static_cast<double>(decimals));
}

/// Success if `value` prints as `printed`. The 1e-12 is for a value that lies on the edge of rounding.
inline testing::AssertionResult prints_as(double value, const std::string& printed) {
  const double expected = std::strtod(printed.c_str(), nullptr);
  if (std::abs(value - expected) <= half_last_digit(printed) + 1e-12) return testing::AssertionSuccess();
  return testing::AssertionFailure() << testing::PrintToString(value) << " does not print as " << printed
                                     << " (off by " << value - expected << ")";
}

}  // namespace astro::golden
