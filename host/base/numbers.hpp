#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Numbers as text, the same in every locale.
namespace astro::recording {

/// The shortest decimal that reads back as the same double; "nan", "inf", "-inf" for those.
std::string to_text(double value);

/// Seconds with six decimals, exact: 1234567 -> "1.234567".
std::string seconds_text(std::int64_t time_us);

/// Nothing unless the whole text is one number.
std::optional<double> number_in(std::string_view text);
std::optional<int> integer_in(std::string_view text);

}  // namespace astro::recording
