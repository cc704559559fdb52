#include "host/report/numbers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace astro::report {

namespace {

int leading_exponent(double value) { return static_cast<int>(std::floor(std::log10(std::abs(value)))); }

}  // namespace

std::string fixed(double value, int decimals) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool shows_zero = digits.find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !shows_zero ? "−" : "") + digits;
}

int decimals_for(double standard_error, int otherwise) {
  if (!std::isfinite(standard_error) || standard_error <= 0) return otherwise;
  return std::clamp(1 - leading_exponent(standard_error), 0, 9);
}

std::string with_error(double value, double standard_error, int decimals_if_unknown) {
  const int decimals = decimals_for(standard_error, decimals_if_unknown);
  if (!std::isfinite(standard_error) || !std::isfinite(value)) return fixed(value, decimals);
  return fixed(value, decimals) + " ± " + fixed(standard_error, decimals);
}

int six_digits(double value) {
  if (!std::isfinite(value) || value == 0) return 5;
  return std::clamp(5 - leading_exponent(value), 0, 9);
}

int factor_decimals(double value) {
  const double size = std::abs(value);
  return size < 1 ? 2 : size < 10 ? 1 : 0;
}

}  // namespace astro::report
