#include "host/truth/files/file_source.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/utc.hpp"
#include "host/formats/tables/column_name.hpp"
#include "host/formats/tables/table.hpp"
#include "host/formats/tables/text_file.hpp"
#include "host/formats/tables/time_column.hpp"
#include "host/truth/source/plausibility.hpp"

namespace astro::truth {
namespace {

namespace fs = std::filesystem;

struct Column {
  std::size_t at;
  double to_si;
};

/// The column whose name has one of these words, and a unit of the quantity; nothing if there is none.
std::optional<Column> find(const std::vector<std::string>& names,
                           std::initializer_list<std::string_view> words, tables::Quantity quantity) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const tables::ColumnName name = tables::column_name(names[i]);
    if (name.has(words) && name.unit && name.unit->quantity == quantity) return Column{i, name.unit->to_si};
  }
  return std::nullopt;
}

double value(const tables::Table& table, const Column& column) {
  const std::string_view cell = table.cell(column.at);
  const auto number = tables::cell_number(cell, table.style());
  if (!number)
    table.rows().refuse(static_cast<int>(column.at) + 1, tables::shown_cell(cell) + " is no number",
                        TruthFileProblem::not_a_number, {tables::cut_cell(cell)});
  return *number * column.to_si;
}

/// A column of times. Only the ratios of the times matter, so the unit does not.
std::optional<Column> find_time(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (tables::time_name(names[i])) return Column{i, 1};
  return std::nullopt;
}

struct Poses {
  std::vector<recording::TruthSample> rows;
  std::vector<double> part;  // for each row, its fraction of the time from the first row to the last
  bool operator==(const Poses& other) const {
    const auto same = [](const recording::TruthSample& a, const recording::TruthSample& b) {
      return a.x_m == b.x_m && a.y_m == b.y_m &&
             (a.theta_rad == b.theta_rad || (std::isnan(a.theta_rad) && std::isnan(b.theta_rad)));
    };
    return std::equal(rows.begin(), rows.end(), other.rows.begin(), other.rows.end(), same);
  }
};

/// The time of a row, or its number.
double time_of(const tables::Table& table, const std::optional<Column>& time,
               const std::vector<double>& before) {
  if (!time) return static_cast<double>(before.size());
  const double at = value(table, *time);
  if (!before.empty() && !(at > before.back()))
    table.rows().refuse("column " + table.names()[time->at] +
                            ": the time does not increase; sort the rows, or leave the column out",
                        TruthFileProblem::time_not_increasing);
  return at;
}

Poses read_poses(const fs::path& path) {
  const Bytes bytes = tables::text_of_file(path);
  const std::string name = path.string();
  tables::Table table(as_text(bytes), name);
  const auto x = find(table.names(), {"x", "px", "tx"}, tables::Quantity::length);
  const auto y = find(table.names(), {"y", "py", "ty"}, tables::Quantity::length);
  const auto theta = find(table.names(), {"theta", "yaw", "heading"}, tables::Quantity::angle);
  const auto time = find_time(table.names());
  if (!x || !y)
    throw Error("'" + name + "' has no columns of x and y with their units, such as x_m and y_mm",
                TruthFileProblem::no_position, {name, std::to_string(table.line_of_names())});
  table.require_names();
  Poses poses;
  std::vector<double> times;
  while (table.next()) {
    recording::TruthSample pose;
    pose.x_m = value(table, *x);
    pose.y_m = value(table, *y);
    pose.theta_rad = theta ? value(table, *theta) : std::numeric_limits<double>::quiet_NaN();
    poses.rows.push_back(pose);
    times.push_back(time_of(table, time, times));
  }
  if (poses.rows.size() < 2)
    throw Error("'" + name + "' holds fewer than two poses: the start and the end are needed",
                TruthFileProblem::too_few_poses, {name});
  for (const double at : times) poses.part.push_back((at - times.front()) / (times.back() - times.front()));
  if (!theta) poses.rows.front().theta_rad = 0;  // the frame is the robot's own at the start
  return poses;
}

/// Says whether the file or already its folder is missing.
std::string missing(const fs::path& file) {
  const fs::path folder = file.parent_path();
  return !folder.empty() && !fs::is_directory(folder) ? "there is no folder '" + folder.string() + "'"
                                                      : "there is no file '" + file.string() + "'";
}

constexpr auto kFileTimeTolerance = std::chrono::seconds(2);  // FAT stores times in steps of 2 s

/// Says that the file was written before the run began; "" if it was not, or if the run's start is unknown.
std::string too_old(const fs::path& file, const recording::Run& run) {
  const std::optional<UtcTime> started = utc_time(run.info.started_at);
  const auto written = std::chrono::floor<std::chrono::microseconds>(
      std::chrono::file_clock::to_sys(fs::last_write_time(file)));
  if (!started || written >= *started - kFileTimeTolerance) return "";
  return "'" + file.string() + "' was written at " + utc_text(written) + ", before this run began at " +
         run.info.started_at + ", so it is not its ground truth (if it is, save it again)";
}

/// Asks until there is a readable file that was written after the run began.
Poses poses_from(const fs::path& file, const recording::Run& run, const Ask& ask) {
  if (!fs::exists(file))
    ask({"the ground truth of this run belongs into '" + file.string() + "' (" + missing(file) + ")",
         {},
         AnswerKind::file_saved});
  while (true) {
    Question again{missing(file) + " for the ground truth of this run", {}, AnswerKind::file_saved};
    if (fs::exists(file)) try {
        const std::string old = too_old(file, run);
        if (old.empty()) return read_poses(file);
        again = {old, {}, AnswerKind::file_saved};
      } catch (const Error& error) {
        again = {"", error.remark(), AnswerKind::file_corrected};
      }
    ask(again);
  }
}

/// Start and end pose for the samples in which the robot stood there, the others by their time.
std::vector<recording::TruthSample> placed(const recording::Run& run, const Poses& poses) {
  if (run.odometry.empty()) return {};
  constexpr std::int64_t kStretch_us = 500'000;
  std::vector<recording::TruthSample> samples =
      at_both_ends(run, poses.rows.front(), poses.rows.back(), kStretch_us);
  const std::int64_t from = run.odometry.front().time_us + kStretch_us;
  const std::int64_t to = run.odometry.back().time_us - kStretch_us;
  std::vector<recording::TruthSample> middle;
  for (std::size_t i = 1; i + 1 < poses.rows.size() && to > from; ++i) {
    middle.push_back(poses.rows[i]);
    middle.back().time_us = from + std::llround(poses.part[i] * static_cast<double>(to - from));
  }
  const auto late =
      std::find_if(samples.begin(), samples.end(), [&](const auto& s) { return s.time_us > from; });
  samples.insert(late, middle.begin(), middle.end());
  return samples;
}

}  // namespace

std::string truth_file_name(const recording::RunInfo& info) {
  std::string name = info.phase.empty() ? info.kind : info.phase + "-" + info.kind;
  if (info.direction) name += "-" + std::string(name_of(*info.direction));
  return name + "-" + std::to_string(info.index) + ".csv";
}

std::optional<std::vector<recording::TruthSample>> FileSource::complete(const recording::Run& run) {
  const fs::path file = folder_ / truth_file_name(run.info);
  Poses poses = poses_from(file, run, ask_);
  while (true) {
    const std::string why = implausible_end(run, poses.rows.front(), poses.rows.back());
    if (why.empty()) break;
    ask_({"'" + file.string() + "': " + why, {}, AnswerKind::file_corrected_or_kept});
    Poses again = poses_from(file, run, ask_);
    const bool same = again == poses;
    poses = std::move(again);
    if (same) break;
  }
  return placed(run, poses);
}

}  // namespace astro::truth
