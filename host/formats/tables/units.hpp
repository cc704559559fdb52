#pragma once

#include <optional>
#include <string_view>

/// Units as people write them above columns, in any case.
namespace astro::tables {

enum class Quantity : unsigned char { length, angle, time, counts, speed, angular_speed, counts_speed };

struct Unit {
  Quantity quantity = Quantity::length;
  double to_si = 1;  // of a value to m, rad, s, counts, m/s, rad/s or counts/s
};

/// "Meters", "mm", "deg", "rad/s", "rpm", "m_s", "ticks"; nothing for any other text.
std::optional<Unit> unit_named(std::string_view text);

std::optional<double> metres_per(std::string_view unit);
std::optional<double> radians_per(std::string_view unit);
std::optional<int> ns_power(std::string_view unit);  // of ten, to nanoseconds: s 9, ms 6, us 3, ns 0

}  // namespace astro::tables
