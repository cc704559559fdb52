#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace astro::importing {

/// Reads a decimal number as a time in nanoseconds. "1700000000.123456789" in seconds (unit 1'000'000'000 ns)
/// is exact, and further digits are cut off; with an exponent the time has the precision of a double. Nothing
/// if the text is not a number or exceeds 2^62 ns, which is in 2116.
std::optional<std::int64_t> time_in(std::string_view text, std::int64_t unit_ns);

}  // namespace astro::importing
