#include "host/formats/tables/time_column.hpp"

#include <algorithm>
#include <vector>

#include "host/formats/tables/column_name.hpp"

namespace astro::tables {
namespace {

constexpr std::int64_t kDay_ns = 86'400'000'000'000;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ".") + word;
  return text;
}

}  // namespace

std::optional<TimeName> time_name(std::string_view text) {
  ColumnName name = column_name(text);
  if (name.words.empty()) return std::nullopt;
  if (!name.unit && name.unit_text.empty()) {
    // The unit alone is a name of times, too, except those of one letter.
    const auto power = ns_power(name.words.back());
    if (power && name.words.back().size() > 1) {
      name.words.pop_back();
      return TimeName{joined(name.words), power};
    }
  }
  if (name.unit && name.unit->quantity != Quantity::time) return std::nullopt;
  if (!name.unit && !name.unit_text.empty()) return std::nullopt;
  const auto says_time = [](const std::string& word) {
    return word == "time" || word == "timestamp" || word == "stamp" || word == "t" || word == "times" ||
           word == "elapsed" || word == "datetime" || word == "timestamps";
  };
  if (!says_time(name.words.front()) && !says_time(name.words.back())) return std::nullopt;
  return TimeName{joined(name.words), name.unit ? ns_power(name.unit_text) : std::nullopt};
}

bool TimeColumns::take(std::size_t column, const TimeName& name) {
  if (!at) {
    at = column;
    stem = name.stem;
    power = name.power;
    return true;
  }
  if (nanoseconds || name.stem != stem) return false;
  if (power == 9 && name.power == 0) {
    nanoseconds = column;
    return true;
  }
  if (power == 0 && name.power == 9) {
    nanoseconds = at;
    at = column;
    power = 9;
    return true;
  }
  return false;
}

std::optional<TimeFormat> time_format(Table& table, const TimeColumns& columns) {
  constexpr std::size_t kRowsLookedAt = 400;
  if (columns.power) return TimeFormat{TimeKind::number, *columns.power};
  std::vector<double> times;
  double first = 0, last = 0;
  table.rewind();
  while (table.next()) {
    const std::string_view cell = table.cell(*columns.at);
    if (const auto kind = times.empty() ? written_time(cell) : std::nullopt) {
      table.rewind();
      return TimeFormat{*kind, 0};
    }
    const auto value = cell_number(cell, table.separator());
    if (!value) continue;
    if (times.empty()) first = *value;
    last = *value;
    if (times.size() < kRowsLookedAt) times.push_back(*value);
  }
  table.rewind();
  const auto power = power_found(times, last - first);
  if (!power) return std::nullopt;
  return TimeFormat{TimeKind::number, *power};
}

std::optional<std::int64_t> TimeReader::read(std::string_view cell, std::string_view nanoseconds) {
  auto time = time_ns(cell, format_, separator_);
  if (!time) return std::nullopt;
  if (columns_.nanoseconds) {
    const auto more = exact_ns(nanoseconds, 0, separator_);
    if (!more) return std::nullopt;
    *time += *more;
  }
  if (format_.kind != TimeKind::clock) return time;
  *time += days_ns_;
  if (last_ && *time < *last_ - kDay_ns / 2) {
    days_ns_ += kDay_ns;
    *time += kDay_ns;
  }
  last_ = time;
  return time;
}

std::optional<std::int64_t> TimeReader::read(const Table& table) {
  return read(table.cell(*columns_.at),
              columns_.nanoseconds ? table.cell(*columns_.nanoseconds) : std::string_view());
}

}  // namespace astro::tables
