#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace astro::importing {

/// The time that a decimal is, in nanoseconds: "1700000000.123456789" seconds (unit 1'000'000'000 ns) exactly, further
/// digits cut off; with an exponent to the precision of a double. Nothing if the text is no number or is beyond 2^62 ns, which is in 2116.
std::optional<std::int64_t> time_in(std::string_view text, std::int64_t unit_ns);

}  // namespace astro::importing
