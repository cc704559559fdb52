#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

/// Numbers as text, the same in every locale.
namespace astro {

/// The shortest decimal that reads back as the same double; "nan", "inf", "-inf" for those.
std::string to_text(double value);

/// `value`, or 0 if with this many decimals it would be printed as "-0.00": a minus sign before zeros looks
/// like an error. Compares the printed text, so that ties round as fmt rounds them.
double without_minus_zero(double value, int decimals);

/// Seconds with six decimals, exact: 1234567 -> "1.234567".
std::string seconds_text(std::int64_t time_us);

/// Nothing unless the whole text is one number.
std::optional<double> number_in(std::string_view text);
std::optional<int> integer_in(std::string_view text);
std::optional<std::uint64_t> unsigned_in(std::string_view text);

/// Reads a count from the text of a file. Throws astro::Error, which shows the name and the text, for anything but a whole
/// number from 0 to the greatest int, because a plain conversion turns 1e300 and 2^32 + 5 into other numbers.
int count_in(std::string_view text, std::string_view name);

/// A number as a person types it: finite, perhaps with a plus sign before it. Nothing if the text is not one.
std::optional<double> typed_number(std::string_view text);

/// Takes a number off the front of `text`; the rest stays, perhaps with a unit. Nothing, and `text`
/// unchanged, if it does not begin with a number.
template <class T>
std::optional<T> take_number(std::string_view& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace astro
