#include "host/import/wheels/wheel_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/order_statistics.hpp"
#include "host/base/text/trimmed.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/time_text.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "host/import/wheels/wheel_columns.hpp"

namespace astro::importing {
namespace {

constexpr std::size_t kMostCells = 1000;

[[noreturn]] void refuse_line(const std::string& name, int line, const std::string& what,
                              WheelTableProblem problem, const std::vector<std::string>& cell = {}) {
  std::vector<std::string> values{name, std::to_string(line)};
  values.insert(values.end(), cell.begin(), cell.end());
  throw Error(fmt::format("{}, line {}: {}", name, line, what), problem, std::move(values));
}

/// Reads the lines of a text file of any size, without their line ends (LF or CRLF) and a byte order mark.
class LineReader {
 public:
  LineReader(ByteSource& file, std::string name) : file_(file), name_(std::move(name)) {}

  /// The next line; nothing after the last one. The text is valid until the next call. Throws astro::Error
  /// naming the file and the line if a line has more than 64 KiB or a NUL byte.
  std::optional<std::string_view> next();
  int line() const { return line_; }  // of the last one, from 1

 private:
  ByteSource& file_;
  std::string name_;
  std::uint64_t at_ = 0;
  int line_ = 0;
};

std::optional<std::string_view> LineReader::next() {
  constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 10;
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (at_ >= file_.size()) return std::nullopt;
  ++line_;
  const auto count = static_cast<std::size_t>(std::min(file_.size() - at_, kMostBytes));
  std::string_view text = as_text(file_.read(at_, count));
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos && count == kMostBytes)
    refuse_line(name_, line_, "the line has more than 65536 characters", WheelTableProblem::line_too_long);
  at_ += end == std::string_view::npos ? count : end + 1;
  text = text.substr(0, end);
  if (std::memchr(text.data(), 0, text.size()) != nullptr)
    refuse_line(name_, line_, "this is not text", WheelTableProblem::not_text);
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  if (line_ == 1 && text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

/// Splits a line at the separator; several blanks count as one.
void split(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  while (cells.size() < kMostCells) {
    if (separator == ' ') line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    const std::size_t end = line.find(separator);
    cells.push_back(trimmed(line.substr(0, end), " \""));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  if (separator == ' ' && cells.size() > 1 && cells.back().empty()) cells.pop_back();
}

char separator_of(std::string_view line) {
  for (const char separator : {'\t', ';', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

std::optional<double> number(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

struct LostRows {
  int steps = 0;              // in which rows are missing
  std::int64_t first_ns = 0;  // end of the first of them
  double part = 0;            // of the whole travel, missing with them
};

constexpr double kEvenStep = 0.2, kLongerStep = 1.5;  // of the usual step
constexpr double kMostlyEven = 0.75;                  // of all steps
constexpr double kHeldTravel = 0.75;                  // of the expected travel; more: the logger was late
constexpr std::size_t kFewestRows = 20;

struct Step {
  double time_ns = 0, travel = 0;  // of both wheels together
};

std::vector<Step> steps_of(std::span<const WheelSample> sums) {
  std::vector<Step> steps;
  for (std::size_t i = 1; i < sums.size(); ++i)
    steps.push_back(
        {static_cast<double>(sums[i].time_ns - sums[i - 1].time_ns),
         std::abs(sums[i].left - sums[i - 1].left) + std::abs(sums[i].right - sums[i - 1].right)});
  return steps;
}

double usual_ns(const std::vector<Step>& steps) {
  std::vector<double> times_ns;
  for (const Step& step : steps) times_ns.push_back(step.time_ns);
  return median_of(std::move(times_ns));
}

/// Detects lost rows in a log of travel per interval, whose rows come at even intervals. After a longer step
/// the row holds the travel of the whole step if the logger was late, but no more than any other row if rows
/// in between were lost. Nothing if the rows are not even, or if the robot stood still in all longer steps.
std::optional<LostRows> find_lost_rows(std::span<const WheelSample> sums) {
  if (sums.size() < kFewestRows) return std::nullopt;
  const std::vector<Step> steps = steps_of(sums);
  const double usual = usual_ns(steps);
  const auto even = [&](const Step& step) { return std::abs(step.time_ns - usual) < kEvenStep * usual; };
  const auto evenly = std::count_if(steps.begin(), steps.end(), even);
  if (static_cast<double>(evenly) < kMostlyEven * static_cast<double>(steps.size())) return std::nullopt;
  LostRows lost;
  double expected = 0, held = 0, whole = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    whole += steps[i].travel;
    if (i == 0 || i + 1 == steps.size() || steps[i].time_ns < kLongerStep * usual) continue;
    if (!even(steps[i - 1]) || !even(steps[i + 1])) continue;
    expected += (steps[i - 1].travel + steps[i + 1].travel) / 2 * steps[i].time_ns / usual;
    held += steps[i].travel;
    if (lost.steps++ == 0) lost.first_ns = sums[i + 1].time_ns;
  }
  if (!(expected > 0) || held > kHeldTravel * expected) return std::nullopt;
  lost.part = (expected - held) / (whole + expected - held);
  return lost;
}

class Table {
 public:
  Table(ByteSource& file, const std::string& name, const WheelTable& table)
      : lines_(file, name), name_(name), given_(table) {
    const auto by_size = static_cast<std::size_t>(kBytesPerByte * static_cast<double>(file.size()));
    most_rows_ = (kFreeBytes + by_size) / kRowBytes;
  }

  WheelTrack read() {
    while (const auto line = lines_.next()) {
      if (line->find_first_not_of(" \t,;") == std::string_view::npos || line->front() == '#') continue;
      if (separator_ == '\0') {
        begin(*line);
      } else {
        split(*line, separator_, cells_);
        row();
      }
    }
    finish();
    return std::move(track_);
  }

 private:
  /// A row takes 24 bytes of memory as wheels and 56 as odometry. This limit keeps that below four times the
  /// file's size plus 64 MiB. A file whose rows have 20 characters or more never exceeds it.
  static constexpr std::size_t kRowBytes = 80, kFreeBytes = std::size_t{56} << 20;
  static constexpr double kBytesPerByte = 3.9;

  /// Takes the first line that is not empty: the names of the columns, or a row if the names are given.
  void begin(std::string_view line) {
    separator_ = separator_of(line);
    split(line, separator_, cells_);
    choose_columns();
    if (given_.columns.empty()) return;
    // The line holds names although they are given if none of the three cells is a number.
    for (const std::size_t at : {columns_.time, columns_.left, columns_.right})
      if (number(cell(at))) return row();
  }

  void choose_columns() {
    std::vector<std::string_view> names = cells_;
    if (!given_.columns.empty()) split(given_.columns, ',', names);
    const auto columns = wheel_columns(names);
    if (!columns) {
      const std::vector<std::string> found(names.begin(), names.end());
      throw UnclearChoice(
          name_ + ": the columns do not tell time, left and right wheel with their units: " + listed(found),
          found, WheelProblem::columns_unclear);
    }
    columns_ = *columns;
    columns_.per_interval = columns_.per_interval || given_.per_interval;
    track_.unit = columns_.unit;
  }

  std::string_view cell(std::size_t at) const { return at < cells_.size() ? cells_[at] : std::string_view(); }

  [[noreturn]] void refuse_cell(std::size_t at, const std::string& what, WheelTableProblem problem) const {
    const bool comma = separator_ != ',' && cell(at).find(',') != std::string_view::npos;
    const std::string column = std::to_string(at + 1), text(cell(at));
    refuse_line(name_, lines_.line(),
                fmt::format("column {}: '{}' {}{}", column, text, what,
                            comma ? "; write it with a decimal point" : ""),
                problem, {column, text});
  }

  double travel(std::size_t at) const {
    const auto value = number(cell(at));
    if (!value) refuse_cell(at, "is not a number", WheelTableProblem::not_a_number);
    return *value * columns_.scale;
  }

  void row() {
    if (cell(columns_.time).empty() || cell(columns_.left).empty() || cell(columns_.right).empty()) {
      // Travel that is missing in one row of travel per interval is missing in all positions after it.
      if (columns_.per_interval)
        refuse_line(
            name_, lines_.line(),
            "a cell is empty, and travel per interval cannot be left out: give every column a cell, and "
            "write numbers with a decimal point",
            WheelTableProblem::cell_empty);
      ++incomplete_;
      return;
    }
    const auto time_ns = time_in(cell(columns_.time), columns_.time_unit_ns);
    if (!time_ns) refuse_cell(columns_.time, "is not a time", WheelTableProblem::not_a_time);
    WheelSample sample{*time_ns, travel(columns_.left), travel(columns_.right)};
    if (!track_.samples.empty()) {
      const WheelSample& before = track_.samples.back();
      if (sample.time_ns < before.time_ns)
        refuse_line(name_, lines_.line(), "the time is before that of the row above: sort the rows",
                    WheelTableProblem::times_fall);
      if (columns_.per_interval) {
        sample.left += before.left;
        sample.right += before.right;
      }
      if (sample.time_ns == before.time_ns) {
        ++repeated_;
        if (columns_.per_interval) track_.samples.back() = sample;
        return;
      }
    }
    if (track_.samples.size() >= most_rows_)
      refuse_line(name_, lines_.line(),
                  "the table has more rows than can be held: split it into one file for each run",
                  WheelTableProblem::too_many_rows);
    track_.samples.push_back(sample);
  }

  void finish() {
    if (track_.samples.size() < 2)
      refuse_line(name_, std::max(lines_.line(), 1), "the table ends with fewer than two rows of wheels",
                  WheelTableProblem::too_few_rows);
    columns_.per_interval ? refuse_lost_rows() : unwrap(track_, name_);
    if (incomplete_ > 0)
      track_.remarks.push_back(
          {name_ + " has " + std::to_string(incomplete_) + " rows with empty cells; they were left out",
           WheelTableProblem::rows_incomplete,
           {name_, std::to_string(incomplete_)}});
    if (repeated_ > 0)
      track_.remarks.push_back(
          {name_ + " has " + std::to_string(repeated_) + " rows that repeat the time of the row above",
           WheelTableProblem::times_repeated,
           {name_, std::to_string(repeated_)}});
  }

  void refuse_lost_rows() const {
    constexpr double kHarmless = 1e-4;  // of the travel: a tenth of the accuracy of calibrations
    const auto lost = find_lost_rows(track_.samples);
    if (!lost || lost->part < kHarmless) return;
    const std::string places = std::to_string(lost->steps),
                      first_s = fmt::format("{:.3f}", 1e-9 * static_cast<double>(lost->first_ns)),
                      percent = fmt::format("{:.2g}", 100 * lost->part);
    throw Error(
        fmt::format(
            "{} has lost rows in {} places, the first before {} s: after longer steps the wheels have gone "
            "no further than in others, so {} % of the travel is missing: record again, and log the "
            "counters themselves, of which a lost row takes nothing away",
            name_, places, first_s, percent),
        WheelTableProblem::rows_lost, {name_, places, first_s, percent});
  }

  LineReader lines_;
  const std::string& name_;
  const WheelTable& given_;
  char separator_ = '\0';
  std::vector<std::string_view> cells_;
  WheelColumns columns_;
  std::size_t most_rows_ = 0, incomplete_ = 0, repeated_ = 0;
  WheelTrack track_;
};

}  // namespace

WheelTrack wheels_in_table(ByteSource& file, const std::string& name, const WheelTable& table) {
  return Table(file, name, table).read();
}

}  // namespace astro::importing
