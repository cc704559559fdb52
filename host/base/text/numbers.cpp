#include "host/base/text/numbers.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "host/base/error.hpp"
#include "host/base/text/number_problem.hpp"

namespace astro {
namespace {

template <class T>
std::optional<T> whole(std::string_view text) {
  const auto value = take_number<T>(text);
  return text.empty() ? value : std::nullopt;
}

}  // namespace

std::string to_text(double value) {
  std::array<char, 32> text{};  // the longest shortest double has 24 characters
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return std::string(text.data(), result.ptr);
}

double without_minus_zero(double value, int decimals) {
  if (!(value < 0) && value != 0) return value;
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_of("123456789in") == std::string::npos ? 0.0 : value;  // "inf" and "nan" stay
}

std::string seconds_text(std::int64_t time_us) {
  // Unsigned, because the most negative time has no positive counterpart.
  const bool negative = time_us < 0;
  const auto magnitude =
      negative ? std::uint64_t{0} - static_cast<std::uint64_t>(time_us) : static_cast<std::uint64_t>(time_us);
  const std::string micros = std::to_string(magnitude % 1'000'000);
  return (negative ? "-" : "") + std::to_string(magnitude / 1'000'000) + "." +
         std::string(6 - micros.size(), '0') + micros;
}

std::optional<double> number_in(std::string_view text) { return whole<double>(text); }
std::optional<int> integer_in(std::string_view text) { return whole<int>(text); }
std::optional<std::uint64_t> unsigned_in(std::string_view text) { return whole<std::uint64_t>(text); }

int count_in(std::string_view text, std::string_view name) {
  constexpr std::size_t kShown = 40;
  const auto count = integer_in(text);
  if (count && *count >= 0) return *count;
  const std::string shown(text.substr(0, kShown));
  throw Error(std::string(name) + " is " + shown + ", not a whole number from 0 to " +
                  std::to_string(std::numeric_limits<int>::max()),
              NumberProblem::not_a_count, {std::string(name), shown});
}

std::optional<double> typed_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto value = number_in(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace astro
