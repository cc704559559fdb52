#include "host/import/wheels/wheel_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/formats/tables/row_times.hpp"
#include "host/formats/tables/stated_columns.hpp"
#include "host/formats/tables/table.hpp"
#include "host/formats/tables/time_column.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/lost_rows.hpp"
#include "host/import/wheels/mean_of_pairs.hpp"
#include "host/import/wheels/speed_integral.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "host/import/wheels/wheel_columns.hpp"

namespace astro::importing {
namespace {

const std::string kNoTime = "is not a time, which is " + std::string(tables::kTimesRead);

/// Reads one pair of wheels for each pair of columns, and joins them at the end.
class WheelRows {
 public:
  WheelRows(std::string_view text, const std::string& name, const WheelTable& given)
      : table_(text, name),
        name_(name),
        given_(given),
        columns_(wheel_columns(tables::names_with(given.columns, table_), table_)),
        times_(columns_.time, format(), table_.style()),
        pairs_(columns_.left.size()) {
    table_.require_names();
    columns_.per_interval = (columns_.per_interval || given.per_interval) && !columns_.speeds;
    const auto by_size = static_cast<std::size_t>(kBytesPerByte * static_cast<double>(text.size()));
    most_rows_ = (kFreeBytes + by_size) / (kRowBytes * pairs_.size());
  }

  WheelTrack read() {
    while (table_.next()) row();
    WheelTrack track;
    track.unit = columns_.unit;
    settle_times(track.remarks);
    if (pairs_.front().size() < 2)
      refuse_line("the table ends with fewer than two rows of wheels", WheelTableProblem::too_few_rows);
    for (Wheels& pair : pairs_) {
      WheelTrack one = track_of(std::move(pair));
      pair = std::move(one.samples);
      if (one.counter_range) track.counter_range = one.counter_range;
      for (const Remark& remark : one.remarks)  // of several wheels on a side they may be equal
        if (std::ranges::find(track.remarks, remark.sentence, &Remark::sentence) == track.remarks.end())
          track.remarks.push_back(remark);
    }
    track.samples =
        mean_of_pairs(std::move(pairs_), named(columns_.left), named(columns_.right), track.remarks);
    add_remarks(track.remarks);
    track.columns = {named({*columns_.time.at}).front(), named(columns_.left), named(columns_.right),
                     values()};
    return track;
  }

 private:
  /// A row takes 24 bytes of memory as wheels and 56 as odometry. This limit keeps that below four times the
  /// file's size plus 64 MiB. A file whose rows have 20 characters or more never exceeds it.
  static constexpr std::size_t kRowBytes = 80, kFreeBytes = std::size_t{56} << 20;
  static constexpr double kBytesPerByte = 3.9;

  [[noreturn]] void refuse_line(const std::string& what, WheelTableProblem problem) const {
    table_.rows().refuse(what, problem);
  }

  [[noreturn]] void refuse_cell(std::size_t at, const std::string& what, WheelTableProblem problem) const {
    const std::string_view cell = table_.cell(at);
    const bool either = table_.separator() == ',' && table_.style().decimal == '\0' &&
                        cell.find(',') != std::string_view::npos;
    table_.rows().refuse(static_cast<int>(at) + 1,
                         tables::shown_cell(cell) + ' ' + what +
                             (either ? ": its comma may be a decimal comma, or group the digits" : ""),
                         problem, {tables::cut_cell(cell)});
  }

  tables::TimeFormat format() {
    columns_.time.settle(table_);
    const std::size_t at = *columns_.time.at;
    const auto found = tables::time_format(table_, columns_.time);
    if (!found) {
      table_.next();
      if (tables::cell_number(table_.cell(at), table_.style()))
        throw Error(
            fmt::format("{}, column {}: the times do not show their unit: s, ms, us and ns are possible",
                        name_, at + 1),
            WheelTableProblem::time_unit_unknown, {name_, std::to_string(at + 1)});
      table_.cells().empty()
          ? refuse_line("the table ends with fewer than two rows of wheels", WheelTableProblem::too_few_rows)
          : refuse_cell(at, kNoTime, WheelTableProblem::not_a_time);
    }
    if (!columns_.time.power && found->kind == tables::TimeKind::number) {
      const std::string unit(tables::unit_text(found->power));
      columns_.remarks.push_back({"the unit of the time is not stated: " + unit + " is assumed",
                                  WheelRemark::time_unit_assumed,
                                  {unit}});
    }
    return *found;
  }

  /// The names of these columns, or their numbers where the table has no names.
  std::vector<std::string> named(const std::vector<std::size_t>& columns) const {
    std::vector<std::string> names;
    for (const std::size_t at : columns)
      names.push_back(at < table_.names().size() ? tables::cut_cell(table_.names()[at])
                                                 : "column " + std::to_string(at + 1));
    return names;
  }

  std::string values() const {
    std::string text(unit_name(columns_.unit));
    if (columns_.speeds) text += "/s";
    if (columns_.scale != 1) text = columns_.unit_text;
    return text + (columns_.per_interval ? ", travel per row" : "");
  }

  double value(std::size_t at) const {
    const auto value = tables::cell_number(table_.cell(at), table_.style());
    if (!value) refuse_cell(at, "is not a number", WheelTableProblem::not_a_number);
    return *value * columns_.scale;
  }

  bool is_incomplete() const {
    bool empty = table_.cell(*columns_.time.at).empty();
    for (const std::size_t at : columns_.left) empty = empty || table_.cell(at).empty();
    for (const std::size_t at : columns_.right) empty = empty || table_.cell(at).empty();
    return empty;
  }

  void row() {
    if (is_incomplete()) {
      // Travel that is missing in one row of travel per interval is missing in all positions after it.
      if (columns_.per_interval)
        refuse_line(
            "a cell is empty, and travel per interval cannot be left out: give every column a cell, and "
            "write numbers with a decimal point",
            WheelTableProblem::cell_empty);
      ++incomplete_;
      return;
    }
    const auto time_ns = times_.read(table_);
    if (!time_ns) refuse_cell(*columns_.time.at, kNoTime, WheelTableProblem::not_a_time);
    if (pairs_.front().size() >= most_rows_)
      refuse_line("the table has more rows than can be held: split it into one file for each run",
                  WheelTableProblem::too_many_rows);
    bool changed = false;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      Wheels& samples = pairs_[i];
      WheelSample sample{*time_ns, value(columns_.left[i]), value(columns_.right[i])};
      if (columns_.per_interval && !samples.empty()) {
        sample.left += samples.back().left;
        sample.right += samples.back().right;
      }
      changed = changed || (!samples.empty() &&
                            (sample.left != samples.back().left || sample.right != samples.back().right));
      samples.push_back(sample);
    }
    row_times_.take(*time_ns, table_.rows().line(), changed);
  }

  /// Mends the times, and leaves out rows that repeat one.
  void settle_times(std::vector<Remark>& remarks) {
    Wheels& first = pairs_.front();
    const tables::SettledTimes settled = row_times_.settle(first, "the wheels", remarks);
    if (settled.fall)
      throw Error(fmt::format("{}, line {}: {}", name_, settled.fall->line, settled.fall->text()),
                  WheelTableProblem::times_fall, {name_, std::to_string(settled.fall->line)});
    if (settled.too_coarse)
      throw Error(
          fmt::format("{}: {} % of the rows with new values repeat the time of the row above, and not "
                      "evenly, so that their times are not known",
                      name_, row_times_.percent_repeated()),
          WheelTableProblem::times_too_coarse, {name_, row_times_.percent_repeated()});
    if (settled.spread) {
      const std::string rows = fmt::format("{:.3g}", settled.spread->rows_in_step),
                        step_s = fmt::format("{:.3g}", settled.spread->step_s);
      remarks.push_back({fmt::format("{} has {} rows of each time, which are {} s apart; they were spread "
                                     "evenly in between",
                                     name_, rows, step_s),
                         WheelTableProblem::times_spread,
                         {name_, rows, step_s}});
    }
    const std::size_t rows = first.size();
    for (Wheels& pair : pairs_)
      for (std::size_t i = 0; i < rows; ++i) pair[i].time_ns = first[i].time_ns;
    for (Wheels& pair : pairs_) leave_out_repeated(pair);
    if (const std::size_t left_out = rows - first.size(); left_out > 0)
      remarks.push_back({name_ + " has " + std::to_string(left_out) +
                             (left_out == 1 ? " row that repeats" : " rows that repeat") +
                             " the time of the row above; left out",
                         WheelTableProblem::times_repeated,
                         {name_, std::to_string(left_out)}});
  }

  /// Of travel per interval the last row of a time holds that of the others, too.
  void leave_out_repeated(Wheels& samples) const {
    std::size_t kept = 0;
    for (const WheelSample& sample : samples) {
      if (kept == 0 || sample.time_ns != samples[kept - 1].time_ns)
        samples[kept++] = sample;
      else if (columns_.per_interval)
        samples[kept - 1] = sample;
    }
    samples.resize(kept);
  }

  WheelTrack track_of(std::vector<WheelSample> samples) const {
    WheelTrack track;
    track.unit = columns_.unit;
    if (columns_.speeds) {
      track.samples = integral_of(samples, "the speeds of the wheels", track.remarks);
      return track;
    }
    track.samples = std::move(samples);
    if (columns_.per_interval)
      refuse_lost_rows(track.samples);
    else
      unwrap(track, name_, given_.counter_range);
    return track;
  }

  void add_remarks(std::vector<Remark>& remarks) const {
    remarks.insert(remarks.begin(), columns_.remarks.begin(), columns_.remarks.end());
    if (incomplete_ > 0)
      remarks.push_back(
          {name_ + " has " + std::to_string(incomplete_) +
               (incomplete_ == 1 ? " row with an empty cell; it was" : " rows with empty cells; they were") +
               " left out",
           WheelTableProblem::rows_incomplete,
           {name_, std::to_string(incomplete_)}});
    if (const auto range_s = times_.started_again_s())
      remarks.push_back({fmt::format("{}: the times start again after {:.6g} s; they were made continuous",
                                     name_, *range_s),
                         WheelTableProblem::times_continued,
                         {name_, fmt::format("{:.6g}", *range_s)}});
  }

  void refuse_lost_rows(std::span<const WheelSample> samples) const {
    constexpr double kHarmless = 1e-4;  // of the travel: a tenth of the accuracy of calibrations
    const auto lost = find_lost_rows(samples);
    if (!lost || lost->part < kHarmless) return;
    const std::string places = std::to_string(lost->steps),
                      first_s = fmt::format("{:.3f}", 1e-9 * static_cast<double>(lost->first_ns)),
                      percent = fmt::format("{:.2g}", 100 * lost->part);
    throw Error(
        fmt::format(
            "{} has lost rows in {} places, the first before {} s: after longer steps the wheels have gone "
            "no further than in others, so {} % of the travel is missing: record again with a clock that "
            "nothing sets, and log the "
            "counters themselves, of which a lost row takes nothing away",
            name_, places, first_s, percent),
        WheelTableProblem::rows_lost, {name_, places, first_s, percent});
  }

  tables::Table table_;
  const std::string& name_;
  const WheelTable& given_;
  WheelColumns columns_;
  tables::TimeReader times_;
  std::vector<Wheels> pairs_;
  std::size_t most_rows_ = 0, incomplete_ = 0;
  tables::RowTimes row_times_;
};

}  // namespace

WheelTrack wheels_in_table(std::string_view text, const std::string& name, const WheelTable& table) {
  return WheelRows(text, name, table).read();
}

}  // namespace astro::importing
