#include "host/formats/tables/time_column.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/formats/tables/column_name.hpp"

namespace astro::tables {
namespace {

constexpr std::int64_t kDay_ns = 86'400'000'000'000, kHour_ns = kDay_ns / 24;
constexpr int kSeconds = 9;  // power of ten, to nanoseconds

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
           word == "elapsed" || word == "datetime" || word == "timestamps" || word == "tv" ||
           word == "epoch" || word == "clock" || word == "unix" || word == "zeit" || word == "zeitstempel" ||
           word == "uhrzeit" || word == "temps" || word == "tiempo" || word == "tempo";
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
  if (fraction || (name.stem != stem && !name.stem.empty() && !stem.empty())) return false;
  const auto seconds = [](const std::optional<int>& one) { return !one || *one == kSeconds; };
  if (seconds(power) && name.power && *name.power < kSeconds) {
    fraction = column;
    fraction_power = *name.power;
    return true;
  }
  if (power && *power < kSeconds && seconds(name.power)) {
    fraction = at;
    fraction_power = *power;
    at = column;
    power = name.power;
    return true;
  }
  return false;
}

void TimeColumns::settle(Table& table) {
  if (!fraction) return;
  const double whole_second = std::pow(10, kSeconds - fraction_power);
  bool whole = true, fractions = true, any = false, written = false;
  table.rewind();
  while (whole && table.next()) {
    const std::string_view cell = table.cell(*at);
    const auto part = cell_number(table.cell(*fraction), table.style());
    const auto value = cell_number(cell, table.style());
    written = !value && written_time(cell);
    if (!part || (!value && !written)) continue;
    any = true;
    whole = value ? *value == std::floor(*value) : cell.find_first_of(".,") == std::string_view::npos;
    fractions = fractions && *part >= 0 && *part < whole_second;
  }
  table.rewind();
  if (any && whole && fractions) {
    if (!written) power = kSeconds;
    return;
  }
  if (any && whole && !written) {
    at = fraction;
    power = fraction_power;
  }
  fraction.reset();
}

std::optional<TimeFormat> time_format(Table& table, const TimeColumns& columns) {
  constexpr std::size_t kRowsLookedAt = 400;
  if (columns.power) {
    table.rewind();
    std::optional<TimeKind> written;
    while (!written && table.next() && !cell_number(table.cell(*columns.at), table.style()))
      written = written_time(table.cell(*columns.at));
    table.rewind();
    if (written) return TimeFormat{*written, 0};
    return TimeFormat{TimeKind::number, *columns.power};
  }
  std::vector<double> times;  // without repeated ones: whole seconds may have hundreds of rows in each
  double last = 0, span = 0;
  bool several = false;
  table.rewind();
  while (table.next()) {
    const std::string_view cell = table.cell(*columns.at);
    if (const auto kind = times.empty() ? written_time(cell) : std::nullopt) {
      table.rewind();
      return TimeFormat{*kind, 0};
    }
    const auto value = cell_number(cell, table.style());
    if (!value) continue;
    several = several || !times.empty();
    if (several) span += std::max(0.0, *value - last);  // times may start again
    last = *value;
    if (times.size() < kRowsLookedAt && (times.empty() || *value != times.back())) times.push_back(*value);
  }
  table.rewind();
  if (several && times.size() == 1) return std::nullopt;
  const auto power = power_found(times, span);
  if (!power) return std::nullopt;
  return TimeFormat{TimeKind::number, *power};
}

std::optional<std::int64_t> TimeReader::read(std::string_view cell, std::string_view fraction) {
  auto time = time_ns(cell, format_, style_);
  if (!time) return std::nullopt;
  if (columns_.fraction) {
    const auto more = exact_ns(fraction, columns_.fraction_power, style_);
    if (!more) return std::nullopt;
    *time += *more;
  }
  if (format_.kind == TimeKind::number) return continued(*time);
  if (format_.kind == TimeKind::date) return time;
  *time += passed_ns_;
  if (last_ && *time < *last_ - kDay_ns / 2) {
    passed_ns_ += kDay_ns;
    *time += kDay_ns;
  }
  // Minutes and seconds alone go on after the hour.
  const bool minutes =
      std::count(cell.begin(), cell.end(), ':') == 1 && cell.find_first_of(".,") != cell.npos;
  if (minutes && last_ && *time < *last_ - kHour_ns / 2) {
    passed_ns_ += kHour_ns;
    *time += kHour_ns;
  }
  last_ = time;
  return time;
}

/// A number that falls by nearly one of these ranges went over its end if the step is one of the usual ones then.
std::int64_t TimeReader::continued(std::int64_t time_ns) {
  constexpr std::int64_t kMicro_ns = 1'000, kMilli_ns = 1'000'000, k16Bits = 65'536, k32Bits = 4'294'967'296;
  constexpr std::int64_t kUsual = 3;  // times the longest step
  time_ns += passed_ns_;
  if (last_ && time_ns < *last_ && longest_ns_ > 0) {
    for (const std::int64_t range_ns :
         {k16Bits * kMicro_ns, k16Bits * kMilli_ns, k32Bits * kMicro_ns, k32Bits * kMilli_ns}) {
      const std::int64_t step_ns = time_ns + range_ns - *last_;
      if (step_ns <= 0 || step_ns > kUsual * longest_ns_ || *last_ - passed_ns_ >= range_ns) continue;
      passed_ns_ += range_ns;
      time_ns += range_ns;
      started_again_s_ = 1e-9 * static_cast<double>(range_ns);
      break;
    }
  }
  if (last_) longest_ns_ = std::max(longest_ns_, time_ns - *last_);
  last_ = time_ns;
  return time_ns;
}

std::optional<std::int64_t> TimeReader::read(const Table& table) {
  return read(table.cell(*columns_.at),
              columns_.fraction ? table.cell(*columns_.fraction) : std::string_view());
}

}  // namespace astro::tables
