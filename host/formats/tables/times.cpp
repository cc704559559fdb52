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

/// Takes up to `most` digits off the text; nothing if it does not begin with one.
std::optional<int> take_whole(std::string_view& text, std::size_t most) {
  int value = 0;
  std::size_t digits = 0;
  for (; digits < most && digits < text.size() && is_digit(text[digits]); ++digits)
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

/// The digits behind a point, in nanoseconds.
std::optional<std::int64_t> take_fraction(std::string_view& text) {
  std::int64_t ns = 0, place = kSecond_ns / 10;
  if (text.empty() || !is_digit(text.front())) return std::nullopt;
  for (; !text.empty() && is_digit(text.front()); text.remove_prefix(1), place /= 10)
    ns += (text.front() - '0') * place;
  return ns;
}

bool begins_fraction(std::string_view text) { return text.starts_with('.') || text.starts_with(','); }

/// "AM" or " p.m."; adds twelve hours to an hour after noon, and takes them off midnight. Nothing if the hour is none of a
/// clock with twelve.
std::optional<std::int64_t> take_half_day(std::string_view& text, std::int64_t ns, int hour) {
  std::string word;
  std::string_view rest = text;
  while (word.size() < 2 && !rest.empty()) {
    if (rest.front() != ' ' && rest.front() != '.') word += static_cast<char>(rest.front() & ~0x20);
    rest.remove_prefix(1);
  }
  if (word != "AM" && word != "PM") return ns;
  if (rest.starts_with('.')) rest.remove_prefix(1);
  if (hour < 1 || hour > 12) return std::nullopt;
  text = rest;
  return ns + ((word == "PM" ? 12 : 0) - (hour == 12 ? 12 : 0)) * 3600 * kSecond_ns;
}

/// hh:mm, hh:mm:ss or mm:ss.f; seconds perhaps with a fraction, or with three or six digits of it behind a third colon, as some
/// loggers write it; two digits there may be frames of a film. AM or PM may follow.
std::optional<std::int64_t> take_clock(std::string_view& text) {
  const auto first = take_whole(text, 2);
  if (!first || *first > 59 || !take_mark(text, ':')) return std::nullopt;
  const auto minute = take_whole(text, 2);
  if (!minute || *minute > 59) return std::nullopt;
  if (begins_fraction(text)) {
    text.remove_prefix(1);
    const auto fraction = take_fraction(text);
    if (!fraction) return std::nullopt;
    return (*first * 60 + *minute) * kSecond_ns + *fraction;
  }
  if (*first > 24) return std::nullopt;
  std::int64_t ns = (*first * 60 + *minute) * 60 * kSecond_ns;
  if (take_mark(text, ':')) {
    const auto second = take_whole(text, 2);
    if (!second || *second > 60) return std::nullopt;
    ns += *second * kSecond_ns;
    const std::size_t digits =
        text.substr(std::min<std::size_t>(1, text.size())).find_first_not_of("0123456789");
    const std::size_t behind =
        (digits == std::string_view::npos ? text.size() - (text.empty() ? 0 : 1) : digits);
    if (begins_fraction(text) || (text.starts_with(':') && (behind == 3 || behind == 6))) {
      text.remove_prefix(1);
      const auto fraction = take_fraction(text);
      if (!fraction) return std::nullopt;
      ns += *fraction;
    }
  }
  return take_half_day(text, ns, *first);
}

/// YYYY-MM-DD, YYYY/MM/DD, DD.MM.YYYY, or DD/MM/YYYY and MM/DD/YYYY if only one of them is a date; in days since 1970.
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
  int year = *first, month = *second, day = *third;
  if (mark == '.' || (mark == '/' && *third > 31)) {
    // Which of two small numbers is the month, slashes do not show.
    if (mark == '/' && *first <= 12 && *second <= 12 && *first != *second) return std::nullopt;
    const bool month_first = mark == '/' && *second > 12;
    year = *third;
    month = month_first ? *first : *second;
    day = month_first ? *second : *first;
  }
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
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

std::optional<std::int64_t> time_ns(std::string_view cell, TimeFormat format, NumberStyle style) {
  switch (format.kind) {
    case TimeKind::date:
      return date_ns(cell);
    case TimeKind::clock:
      return clock_ns(cell);
    case TimeKind::number:
      break;
  }
  return exact_ns(cell, format.power, style);
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
  // The size of a time since 1970 shows its unit: in only one unit it is between the years 2001 and 2600.
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
