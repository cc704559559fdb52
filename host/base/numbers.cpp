#include "host/base/numbers.hpp"

#include <array>
#include <charconv>

namespace astro::recording {
namespace {

template <class T>
std::optional<T> whole(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string to_text(double value) {
  std::array<char, 32> text{};  // the longest shortest double has 24 characters
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return std::string(text.data(), result.ptr);
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

}  // namespace astro::recording
