#include "host/import/wheels/time_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace astro::importing {
namespace {

constexpr double kLimit = 4.6e18;  // a little below 2^62, so that the difference of two times fits

std::optional<std::int64_t> rounded(std::string_view text, std::int64_t unit_ns) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  value *= static_cast<double>(unit_ns);
  if (error != std::errc{} || end != text.data() + text.size() || !(std::abs(value) < kLimit))
    return std::nullopt;
  return std::llround(value);
}

}  // namespace

std::optional<std::int64_t> time_in(std::string_view text, std::int64_t unit_ns) {
  if (text.starts_with('+')) text.remove_prefix(1);
  if (text.find_first_of("eEnN") != std::string_view::npos) return rounded(text, unit_ns);
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, point);
  std::string_view fraction = point < text.size() ? text.substr(point + 1) : std::string_view();
  if ((whole.empty() && fraction.empty()) ||
      text.find_first_not_of("0123456789.") != std::string_view::npos ||
      fraction.find('.') != std::string_view::npos)
    return std::nullopt;
  std::int64_t units = 0;
  for (const char digit : whole) {
    if (units > static_cast<std::int64_t>(kLimit) / 10) return std::nullopt;
    units = units * 10 + (digit - '0');
  }
  if (static_cast<double>(units) * static_cast<double>(unit_ns) > kLimit) return std::nullopt;
  std::int64_t time_ns = units * unit_ns;
  for (std::int64_t place = unit_ns / 10; place > 0 && !fraction.empty();
       place /= 10, fraction.remove_prefix(1))
    time_ns += (fraction.front() - '0') * place;
  return negative ? -time_ns : time_ns;
}

}  // namespace astro::importing
