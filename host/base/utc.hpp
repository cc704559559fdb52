#pragma once

#include <chrono>
#include <optional>
#include <string>

/// Times of day in recordings and journals: ISO 8601 in UTC, to the second.
namespace astro {

using UtcTime = std::chrono::sys_time<std::chrono::microseconds>;

/// "2026-03-01T12:00:00Z"; fractions of a second are cut off.
std::string utc_text(UtcTime time);
std::string utc_now();

/// The time that `text` says in this form; nothing if it is no such time, or one before 1970.
std::optional<UtcTime> utc_time(const std::string& text);

}  // namespace astro
