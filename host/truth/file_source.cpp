#include "host/truth/file_source.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "host/base/csv_table.hpp"
#include "host/base/error.hpp"
#include "host/recording/files.hpp"

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
  double number = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(number))
    refuse(name, row.line, "'" + cell + "' is no number");
  return number * column.scale;
}

std::vector<recording::TruthSample> read_poses(const fs::path& path) {
  const recording::Bytes bytes = recording::load_file(path);
  const std::string name = path.string();
  const CsvTable table = split_csv(recording::as_text(bytes), name);
  const auto x = find(table.header, "x_m", "x_mm", 1e-3);
  const auto y = find(table.header, "y_m", "y_mm", 1e-3);
  const auto theta = find(table.header, "theta_rad", "theta_deg", std::numbers::pi / 180);
  if (!x || !y) refuse(name, table.header.line, "columns x_m or x_mm and y_m or y_mm are needed");
  std::vector<recording::TruthSample> poses;
  for (const CsvRow& row : table.rows) {
    recording::TruthSample pose;
    pose.x_m = value(row, *x, name);
    pose.y_m = value(row, *y, name);
    pose.theta_rad = theta ? value(row, *theta, name) : std::numeric_limits<double>::quiet_NaN();
    poses.push_back(pose);
  }
  if (poses.size() < 2)
    throw Error("'" + name + "' holds fewer than two poses: the start and the end are needed");
  if (!theta) poses.front().theta_rad = 0;  // the frame is that of the start
  return poses;
}

}  // namespace

std::string truth_file_name(const recording::RunInfo& info) {
  std::string name = info.phase.empty() ? info.kind : info.phase + "-" + info.kind;
  if (info.direction == recording::Direction::cw) name += "-cw";
  if (info.direction == recording::Direction::ccw) name += "-ccw";
  return name + "-" + std::to_string(info.index) + ".csv";
}

std::vector<recording::TruthSample> FileSource::poses_in(const fs::path& file) const {
  if (!fs::exists(file))
    ask_("save the ground truth of this run as '" + file.string() + "', then press Enter: ");
  while (true) {
    std::string why;
    try {
      return read_poses(file);
    } catch (const Error& error) {
      why = error.what();
    }
    ask_(why + "; correct the file, then press Enter: ");
  }
}

std::vector<recording::TruthSample> FileSource::complete(const recording::Run& run) {
  std::vector<recording::TruthSample> poses = poses_in(folder_ / truth_file_name(run.info));
  if (run.odometry.empty()) return {};
  constexpr std::int64_t kStretch_us = 500'000;
  std::vector<recording::TruthSample> samples = at_both_ends(run, poses.front(), poses.back(), kStretch_us);
  const std::int64_t from = run.odometry.front().time_us + kStretch_us;
  const std::int64_t to = run.odometry.back().time_us - kStretch_us;
  std::vector<recording::TruthSample> middle;
  for (std::size_t i = 1; i + 1 < poses.size() && to > from; ++i) {
    poses[i].time_us =
        from + (to - from) * static_cast<std::int64_t>(i) / static_cast<std::int64_t>(poses.size() - 1);
    middle.push_back(poses[i]);
  }
  const auto late =
      std::find_if(samples.begin(), samples.end(), [&](const auto& s) { return s.time_us > from; });
  samples.insert(late, middle.begin(), middle.end());
  return samples;
}

}  // namespace astro::truth
