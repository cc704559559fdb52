#include "host/formats/tables/times.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <vector>

#include "host/base/order_statistics.hpp"
#include "host/formats/tables/rows.hpp"

namespace astro::tables {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes up to `most` digits off the text; nothing if it does not begin with one.
std::optional<int> take_whole(std::string_view& text, std::size_t most) {
  int value = 0;
  std::size_t digits = 0;
  for (; digits < most && digits < text.size() && is_decimal_digit(text[digits]); ++digits)
    value = 10 * value + (text[digits] - '0');
  if (digits == 0) return std::nullopt;
  text.remove_prefix(digits);
  return value;
}

bool take_mark(std::string_view& text, char mark) {
  if (!text.starts_with(mark)) return false;
  text.remove_prefix(1);
  return true;
}

/// hh:mm or hh:mm:ss, perhaps with a fraction.
std::optional<std::int64_t> take_clock(std::string_view& text) {
  const auto hour = take_whole(text, 2);
  if (!hour || *hour > 24 || !take_mark(text, ':')) return std::nullopt;
  const auto minute = take_whole(text, 2);
  if (!minute || *minute > 59) return std::nullopt;
  std::int64_t ns = (*hour * 60 + *minute) * 60 * kSecond_ns;
  if (!take_mark(text, ':')) return ns;
  const auto second = take_whole(text, 2);
  if (!second || *second > 60) return std::nullopt;
  ns += *second * kSecond_ns;
  // Some loggers write milliseconds behind a third colon.
  if (!take_mark(text, '.') && !take_mark(text, ',') && !take_mark(text, ':')) return ns;
  std::int64_t place = kSecond_ns / 10;
  if (text.empty() || !is_decimal_digit(text.front())) return std::nullopt;
  for (; !text.empty() && is_decimal_digit(text.front()); text.remove_prefix(1), place /= 10)
    ns += (text.front() - '0') * place;
  return ns;
}

/// YYYY-MM-DD, YYYY/MM/DD or DD.MM.YYYY, in days since 1970.
std::optional<std::int64_t> take_days(std::string_view& text) {
  const auto first = take_whole(text, 4);
  if (!first || text.empty()) return std::nullopt;
  const char mark = text.front();
  if (mark != '-' && mark != '/' && mark != '.') return std::nullopt;
  text.remove_prefix(1);
  const auto second = take_whole(text, 2);
  if (!second || !take_mark(text, mark)) return std::nullopt;
  const auto third = take_whole(text, 4);
  if (!third) return std::nullopt;
  const bool day_first = mark == '.';
  const std::chrono::year_month_day date{
      std::chrono::year(day_first ? *third : *first), std::chrono::month(static_cast<unsigned>(*second)),
      std::chrono::day(static_cast<unsigned>(day_first ? *first : *third))};
  const int year = static_cast<int>(date.year());
  if (!date.ok() || year < 1970 || year > 2200) return std::nullopt;
  return std::chrono::sys_days(date).time_since_epoch().count();
}

/// Z, +hh:mm, +hhmm or +hh; how far the clock is ahead of UTC.
std::optional<std::int64_t> zone_ns(std::string_view text) {
  if (text.empty() || text == "Z" || text == "z" || text == " UTC") return 0;
  const bool behind = text.front() == '-';
  if (!take_mark(text, '+') && !take_mark(text, '-')) return std::nullopt;
  const auto hours = take_whole(text, 2);
  take_mark(text, ':');
  const int minutes = take_whole(text, 2).value_or(0);
  if (!hours || !text.empty() || *hours > 14 || minutes > 59) return std::nullopt;
  const std::int64_t ns = (*hours * 60 + minutes) * 60 * kSecond_ns;
  return behind ? -ns : ns;
}

std::optional<std::int64_t> date_ns(std::string_view text) {
  const auto days = take_days(text);
  if (!days || (!take_mark(text, 'T') && !take_mark(text, ' '))) return std::nullopt;
  const auto clock = take_clock(text);
  const auto zone = clock ? zone_ns(text) : std::nullopt;
  if (!zone) return std::nullopt;
  return *days * 86'400 * kSecond_ns + *clock - *zone;
}

std::optional<std::int64_t> clock_ns(std::string_view text) {
  const auto clock = take_clock(text);
  if (!clock || !text.empty()) return std::nullopt;
  return clock;
}

constexpr int kPowers[] = {9, 6, 3, 0};

}  // namespace

std::optional<std::int64_t> time_ns(std::string_view cell, TimeFormat format, char separator) {
  switch (format.kind) {
    case TimeKind::date:
      return date_ns(cell);
    case TimeKind::clock:
      return clock_ns(cell);
    case TimeKind::number:
      break;
  }
  return exact_ns(cell, format.power, separator);
}

std::optional<TimeKind> written_time(std::string_view cell) {
  if (cell.find(':') == std::string_view::npos) return std::nullopt;
  if (date_ns(cell)) return TimeKind::date;
  if (clock_ns(cell)) return TimeKind::clock;
  return std::nullopt;
}

std::string_view unit_text(int power) {
  return power == 9 ? "s" : power == 6 ? "ms" : power == 3 ? "us" : "ns";
}

std::optional<int> power_found(std::span<const double> times, double span) {
  if (times.empty()) return std::nullopt;
  // A time since 1970 shows its unit: it is one between the years 2001 and 2600 in no other.
  for (const int power : kPowers)
    if (const double seconds = times.front() * std::pow(10, power - 9); seconds > 1e9 && seconds < 2e10)
      return power;
  if (times.size() == 1) return 9;  // nothing depends on it
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] > times[i - 1]) steps.push_back(times[i] - times[i - 1]);
  if (steps.empty()) return std::nullopt;
  const double step = median_of(std::move(steps));
  constexpr double kFastest_s = 1 / 1500.0, kSlowest_s = 5, kShortDrive_s = 2, kLongDrive_s = 7200;
  const auto last = [&](int power) { return span * std::pow(10, power - 9); };
  for (const int power : kPowers) {
    const double step_s = step * std::pow(10, power - 9);
    if (step_s < kFastest_s || step_s >= 1000 * kFastest_s) continue;
    const bool short_drive = last(power) < kShortDrive_s;
    if (short_drive && power < 9 && 1000 * step_s <= kSlowest_s && last(power + 3) < kLongDrive_s)
      return power + 3;
    return power;
  }
  return std::nullopt;
}

}  // namespace astro::tables
