#include "host/truth/files/file_source.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/base/text/csv_table.hpp"
#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/base/utc.hpp"
#include "host/truth/source/plausibility.hpp"

namespace astro::truth {
namespace {

namespace fs = std::filesystem;

struct Column {
  std::size_t index;
  double scale;
};

std::optional<Column> find(const CsvRow& header, const std::string& si, const std::string& other,
                           double scale) {
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    if (header.cells[i] == si) return Column{i, 1};
    if (header.cells[i] == other) return Column{i, scale};
  }
  return std::nullopt;
}

double value(const CsvRow& row, const Column& column, const std::string& name) {
  const std::string& cell = row.cells[column.index];
  const auto number = number_in(cell);
  if (!number || !std::isfinite(*number))
    refuse(name, row.line, "'" + cell + "' is no number", TruthFileProblem::not_a_number, {cell});
  return *number * column.scale;
}

/// A column of times: any name that begins with t, time or timestamp, perhaps followed by a unit. Only the
/// ratios of the times matter, so the unit does not.
std::optional<Column> find_time(const CsvRow& header) {
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    std::string name = header.cells[i];
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    const std::string stem = name.substr(0, name.find_first_of("_ [("));
    if (stem == "t" || stem == "time" || stem == "timestamp" || stem == "stamp") return Column{i, 1};
  }
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

std::vector<double> parts_of(const CsvTable& table, const std::string& name) {
  const auto time = find_time(table.header);
  std::vector<double> times;
  for (const CsvRow& row : table.rows) {
    times.push_back(time ? value(row, *time, name) : static_cast<double>(times.size()));
    if (times.size() > 1 && !(times.back() > times[times.size() - 2]))
      refuse(name, row.line,
             "column " + table.header.cells[time->index] +
                 ": the time does not increase; sort the rows, or leave the column out",
             TruthFileProblem::time_not_increasing);
  }
  const double first = times.front(), last = times.back();
  for (double& one : times) one = (one - first) / (last - first);
  return times;
}

Poses read_poses(const fs::path& path) {
  const Bytes bytes = load_text(path);
  const std::string name = path.string();
  const CsvTable table = split_csv(as_text(bytes), name);
  const auto x = find(table.header, "x_m", "x_mm", 1e-3);
  const auto y = find(table.header, "y_m", "y_mm", 1e-3);
  const auto theta = find(table.header, "theta_rad", "theta_deg", radians(1));
  if (!x || !y)
    refuse(name, table.header.line, "columns x_m or x_mm and y_m or y_mm are needed",
           TruthFileProblem::no_position);
  Poses poses;
  for (const CsvRow& row : table.rows) {
    recording::TruthSample pose;
    pose.x_m = value(row, *x, name);
    pose.y_m = value(row, *y, name);
    pose.theta_rad = theta ? value(row, *theta, name) : std::numeric_limits<double>::quiet_NaN();
    poses.rows.push_back(pose);
  }
  if (poses.rows.size() < 2)
    throw Error("'" + name + "' holds fewer than two poses: the start and the end are needed",
                TruthFileProblem::too_few_poses, {name});
  poses.part = parts_of(table, name);
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
