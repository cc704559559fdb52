#include <cmath>
#include <cstdint>
#include <filesystem>

#include "host/base/text/sense.hpp"
#include "host/recording/csv_export.hpp"
#include "host/recording/run_file.hpp"

/// Writes a run as <folder>/sample.mcap and as CSV for the independent check: ten seconds of a circle with
/// the tracker lost for a while.
int main(int count, char** arguments) {
  using namespace astro::recording;
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  Run run;
  run.info.kind = "circle";
  run.info.direction = astro::Sense::ccw;
  run.info.parameters = {{"c_R", 1.00207}, {"b", 0.29}};
  for (int i = 0; i < 1000; ++i) {
    const double angle_rad = 0.009 * i;
    const auto left = static_cast<std::int32_t>(0x7FFFFFFFU - 500U + static_cast<std::uint32_t>(i));  // wraps
    run.odometry.push_back(
        {10'000 * i + 7, std::sin(angle_rad), 1 - std::cos(angle_rad), angle_rad, 0.9, 0.8, left, -3 * i});
    const bool seen = i < 300 || i > 400;
    run.truth.push_back({10'000 * i + 3007, 5 - std::sin(angle_rad), 0.1 * i, 2 - angle_rad, seen});
  }
  write_run(folder / "sample.mcap", run);
  export_csv(run, folder);
  return 0;
}
