#include "host/formats/tables/units.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

#include "host/base/text/degrees.hpp"

namespace astro::tables {
namespace {

struct Spelling {
  std::string_view text;
  Unit unit;
};

constexpr double kRpm = 2 * std::numbers::pi / 60;

constexpr Spelling kUnits[] = {
    {"m", {Quantity::length, 1}},
    {"meter", {Quantity::length, 1}},
    {"meters", {Quantity::length, 1}},
    {"metre", {Quantity::length, 1}},
    {"metres", {Quantity::length, 1}},
    {"mm", {Quantity::length, 1e-3}},
    {"millimeter", {Quantity::length, 1e-3}},
    {"millimeters", {Quantity::length, 1e-3}},
    {"millimetre", {Quantity::length, 1e-3}},
    {"millimetres", {Quantity::length, 1e-3}},
    {"cm", {Quantity::length, 1e-2}},
    {"centimeter", {Quantity::length, 1e-2}},
    {"centimeters", {Quantity::length, 1e-2}},
    {"centimetre", {Quantity::length, 1e-2}},
    {"centimetres", {Quantity::length, 1e-2}},
    {"dm", {Quantity::length, 0.1}},
    {"decimeter", {Quantity::length, 0.1}},
    {"decimeters", {Quantity::length, 0.1}},
    {"decimetre", {Quantity::length, 0.1}},
    {"decimetres", {Quantity::length, 0.1}},
    {"um", {Quantity::length, 1e-6}},
    {"in", {Quantity::length, 0.0254}},
    {"inch", {Quantity::length, 0.0254}},
    {"inches", {Quantity::length, 0.0254}},
    {"ft", {Quantity::length, 0.3048}},
    {"foot", {Quantity::length, 0.3048}},
    {"feet", {Quantity::length, 0.3048}},
    {"rad", {Quantity::angle, 1}},
    {"radian", {Quantity::angle, 1}},
    {"radians", {Quantity::angle, 1}},
    {"deg", {Quantity::angle, radians(1)}},
    {"degree", {Quantity::angle, radians(1)}},
    {"degrees", {Quantity::angle, radians(1)}},
    {"\xC2\xB0", {Quantity::angle, radians(1)}},
    {"turns", {Quantity::angle, 2 * std::numbers::pi}},
    {"rev", {Quantity::angle, 2 * std::numbers::pi}},
    {"revs", {Quantity::angle, 2 * std::numbers::pi}},
    {"revolutions", {Quantity::angle, 2 * std::numbers::pi}},
    {"s", {Quantity::time, 1}},
    {"sec", {Quantity::time, 1}},
    {"secs", {Quantity::time, 1}},
    {"second", {Quantity::time, 1}},
    {"seconds", {Quantity::time, 1}},
    {"cs", {Quantity::time, 1e-2}},
    {"centiseconds", {Quantity::time, 1e-2}},
    {"ms", {Quantity::time, 1e-3}},
    {"msec", {Quantity::time, 1e-3}},
    {"msecs", {Quantity::time, 1e-3}},
    {"millis", {Quantity::time, 1e-3}},
    {"millisecond", {Quantity::time, 1e-3}},
    {"milliseconds", {Quantity::time, 1e-3}},
    {"us", {Quantity::time, 1e-6}},
    {"\xC2\xB5s", {Quantity::time, 1e-6}},
    {"\xCE\xBCs", {Quantity::time, 1e-6}},
    {"usec", {Quantity::time, 1e-6}},
    {"usecs", {Quantity::time, 1e-6}},
    {"micros", {Quantity::time, 1e-6}},
    {"microsecond", {Quantity::time, 1e-6}},
    {"microseconds", {Quantity::time, 1e-6}},
    {"ns", {Quantity::time, 1e-9}},
    {"nsec", {Quantity::time, 1e-9}},
    {"nsecs", {Quantity::time, 1e-9}},
    {"nanosec", {Quantity::time, 1e-9}},
    {"nanosecs", {Quantity::time, 1e-9}},
    {"nanos", {Quantity::time, 1e-9}},
    {"nanosecond", {Quantity::time, 1e-9}},
    {"nanoseconds", {Quantity::time, 1e-9}},
    {"count", {Quantity::counts, 1}},
    {"counts", {Quantity::counts, 1}},
    {"cnt", {Quantity::counts, 1}},
    {"tick", {Quantity::counts, 1}},
    {"ticks", {Quantity::counts, 1}},
    {"pulse", {Quantity::counts, 1}},
    {"pulses", {Quantity::counts, 1}},
    {"steps", {Quantity::counts, 1}},
    {"m/s", {Quantity::speed, 1}},
    {"mm/s", {Quantity::speed, 1e-3}},
    {"cm/s", {Quantity::speed, 1e-2}},
    {"km/h", {Quantity::speed, 1 / 3.6}},
    {"km_h", {Quantity::speed, 1 / 3.6}},
    {"kmh", {Quantity::speed, 1 / 3.6}},
    {"kph", {Quantity::speed, 1 / 3.6}},
    {"rad/s", {Quantity::angular_speed, 1}},
    {"deg/s", {Quantity::angular_speed, radians(1)}},
    {"rpm", {Quantity::angular_speed, kRpm}},
    {"rev/min", {Quantity::angular_speed, kRpm}},
    {"rps", {Quantity::angular_speed, 2 * std::numbers::pi}},
    {"rev/s", {Quantity::angular_speed, 2 * std::numbers::pi}},
    {"counts/s", {Quantity::counts_speed, 1}},
    {"ticks/s", {Quantity::counts_speed, 1}},
    {"pulses/s", {Quantity::counts_speed, 1}},
    {"cps", {Quantity::counts_speed, 1}},
};

/// In lower case, and with one way to write a quotient: "rad_s", "radps", "rad per sec", "rad s-1" become "rad/s".
std::string normalised(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 40))
    out += c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string_view per : {"_per_", "_s^-1", "_s-1", "*s^-1"})
    if (const std::size_t at = out.find(per); at != std::string::npos)
      out.replace(at, per.size(), per == "_per_" ? "/" : "/s");
  for (const std::string_view end : {"ps", "_s"}) {
    const std::string_view stem =
        std::string_view(out).substr(0, out.size() - std::min(out.size(), end.size()));
    for (const std::string_view known : {"rad", "deg", "m", "mm", "cm", "counts", "ticks", "pulses", "rev"})
      if (out.ends_with(end) && stem == known) return std::string(known) + "/s";
  }
  if (out.ends_with("/sec") || out.ends_with("/second")) out.resize(out.rfind('/') + 2);
  return out;
}

std::optional<double> of(Quantity quantity, std::string_view text) {
  const auto unit = unit_named(text);
  if (!unit || unit->quantity != quantity) return std::nullopt;
  return unit->to_si;
}

}  // namespace

std::optional<Unit> unit_named(std::string_view text) {
  const std::string wanted = normalised(text);
  const auto* const found = std::find_if(std::begin(kUnits), std::end(kUnits),
                                         [&](const Spelling& one) { return one.text == wanted; });
  if (found == std::end(kUnits)) return std::nullopt;
  return found->unit;
}

std::optional<double> metres_per(std::string_view unit) { return of(Quantity::length, unit); }

std::optional<double> radians_per(std::string_view unit) { return of(Quantity::angle, unit); }

std::optional<int> ns_power(std::string_view unit) {
  const auto seconds = of(Quantity::time, unit);
  if (!seconds) return std::nullopt;
  return 9 + static_cast<int>(std::lround(std::log10(*seconds)));
}

}  // namespace astro::tables
