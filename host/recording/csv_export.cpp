#include "host/recording/csv_export.hpp"

#include <cmath>
#include <string>

#include "host/recording/files.hpp"
#include "host/recording/numbers.hpp"

namespace astro::recording {
namespace {

/// A number that is none is an empty cell: PlotJuggler and spreadsheets take that for "no sample".
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

template <class Sample>
void write_table(const std::filesystem::path& path, std::string text, const std::vector<Sample>& samples) {
  for (const Sample& sample : samples) text += row(sample);
  PartFile file(path);
  file.write(as_bytes(text));
  file.commit();
}

}  // namespace

void export_csv(const Run& run, const std::filesystem::path& folder) {
  write_table(folder / "odometry.csv",
              "__time,/odom/x_m,/odom/y_m,/odom/theta_rad,/odom/v_mps,/odom/omega_radps,"
              "/odom/left_counts,/odom/right_counts\n",
              run.odometry);
  write_table(folder / "truth.csv", "__time,/truth/x_m,/truth/y_m,/truth/theta_rad,/truth/valid\n",
              run.truth);
}

}  // namespace astro::recording
