#include "tests/golden/optiodom.hpp"
#include "tests/support/base/places.hpp"

#include <zlib.h>

#include <charconv>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace astro::golden {
namespace {

namespace fs = std::filesystem;
using calibration::BodySample;
using calibration::Trajectory;
using calibration::WheelSample;

constexpr double kMetresPerTick = std::numbers::pi * 0.084 / (43.7 * 64);

// Plain text or gzip: zlib reads both.
std::string text_of(const fs::path& path) {
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) throw std::runtime_error("cannot read " + path.string());
  std::string text;
  char buffer[65536];
  for (int count; (count = gzread(file, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(count));
  gzclose(file);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

using Row = std::vector<std::optional<double>>;  // nothing where a cell is no number

std::vector<Row> rows_of(const fs::path& path) {
  std::istringstream lines(text_of(path));
  std::vector<Row> rows;
  for (std::string line; std::getline(lines, line);) {
    Row row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) {
      double value = 0;
      const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      row.push_back(error == std::errc() && end != cell.data() ? std::optional(value) : std::nullopt);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string stem(const std::string& dataset, int run, const char* kind = "square") {
  return (optiodom_folder() / kind / dataset / (dataset + "_run-0" + std::to_string(run))).string();
}

Trajectory synchronised(const std::string& dataset, int run, const char* kind) {
  Trajectory trajectory;
  trajectory.name = dataset + " run " + std::to_string(run);
  double left = 0, right = 0;
  for (const Row& row : rows_of(stem(dataset, run, kind) + ".csv")) {
    if (row.size() < 6) continue;
    right += *row[4] * kMetresPerTick;
    left += *row[5] * kMetresPerTick;
    trajectory.wheels.push_back({*row[0], left, right});
    trajectory.truth.push_back({*row[0], *row[1], *row[2], *row[3]});
  }
  return trajectory;
}

}  // namespace

fs::path optiodom_folder() {
  const fs::path folder = support::shared_data() / "sousa_optiodom";
  return fs::exists(folder) ? folder : fs::path();
}

Trajectory raw_optiodom_run(const std::string& dataset, int run) {
  Trajectory trajectory;
  trajectory.name = dataset + " run " + std::to_string(run);
  double left = 0, right = 0;
  for (const Row& row : rows_of(stem(dataset, run) + "_odo.csv")) {
    if (row.size() < 3) continue;
    left += *row[1] * kMetresPerTick;
    right += *row[2] * kMetresPerTick;
    trajectory.wheels.push_back({*row[0], left, right});
  }
  for (const Row& row : rows_of(stem(dataset, run) + "_opti.csv.gz"))
    if (row.size() > 7 && row[0] && row[1] && row[2] && row[5] && row[7])
      trajectory.truth.push_back({*row[1], *row[7], *row[5], *row[2] * std::numbers::pi / 180});
  return trajectory;
}

Trajectory synchronised_optiodom_run(const std::string& dataset, int run) {
  return synchronised(dataset, run, "square");
}

Trajectory circular_optiodom_run(const std::string& dataset, int run) {
  return synchronised(dataset, run, "circular");
}

}  // namespace astro::golden
