#include "host/recording/csv_export.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "host/base/text/numbers.hpp"

namespace astro::recording {
namespace {

/// NaN becomes an empty cell, which PlotJuggler and spreadsheets read as "no sample".
std::string cell(double value) { return std::isnan(value) ? "" : to_text(value); }

std::string row(const OdometrySample& sample) {
  return seconds_text(sample.time_us) + ',' + cell(sample.x_m) + ',' + cell(sample.y_m) + ',' +
         cell(sample.theta_rad) + ',' + cell(sample.v_mps) + ',' + cell(sample.omega_radps) + ',' +
         std::to_string(sample.left_counts) + ',' + std::to_string(sample.right_counts) + '\n';
}

std::string row(const TruthSample& sample) {
  const std::string time = seconds_text(sample.time_us);
  if (!sample.valid) return time + ",,,,0\n";
  return time + ',' + cell(sample.x_m) + ',' + cell(sample.y_m) + ',' + cell(sample.theta_rad) + ",1\n";
}

constexpr std::size_t kWriteBytes = 65536;  // written at a time

/// Returns the path; throws if a file of another kind is there.
const std::filesystem::path& replaceable(const std::filesystem::path& path) {
  require_own_kind(path, "__time,/", "export");
  return path;
}

}  // namespace

CsvWriter::Table::Table(const std::filesystem::path& path, std::string heading)
    : file_(replaceable(path)), waiting_(std::move(heading)) {}

void CsvWriter::Table::add(const std::string& row) {
  waiting_ += row;
  if (waiting_.size() < kWriteBytes) return;
  file_.write(as_bytes(waiting_));
  waiting_.clear();
}

void CsvWriter::Table::close() {
  file_.write(as_bytes(waiting_));
  file_.commit();
}

CsvWriter::CsvWriter(const std::filesystem::path& folder)
    : odometry_(folder / "odometry.csv",
                "__time,/odom/x_m,/odom/y_m,/odom/theta_rad,/odom/v_mps,/odom/omega_radps,"
                "/odom/left_counts,/odom/right_counts\n"),
      truth_(folder / "truth.csv", "__time,/truth/x_m,/truth/y_m,/truth/theta_rad,/truth/valid\n") {}

void CsvWriter::add(const OdometrySample& sample) { odometry_.add(row(sample)); }
void CsvWriter::add(const TruthSample& sample) { truth_.add(row(sample)); }

void CsvWriter::close() {
  odometry_.close();
  truth_.close();
}

void export_csv(const Run& run, const std::filesystem::path& folder) {
  CsvWriter writer(folder);
  for (const OdometrySample& sample : run.odometry) writer.add(sample);
  for (const TruthSample& sample : run.truth) writer.add(sample);
  writer.close();
}

}  // namespace astro::recording
