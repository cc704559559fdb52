#include "host/report/sections/series.hpp"

#include <limits>

#include "host/recording/run/aligned_paths.hpp"

namespace astro::report {

std::vector<SeriesPoint> series_of(const recording::Run& run) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto paths = recording::align_paths(run);
  std::vector<SeriesPoint> points;
  points.reserve(paths.odometry.size());
  auto error = paths.error.begin();
  for (const auto& sample : paths.odometry) {
    points.push_back({sample.time_s, sample.pose, {kNone, kNone, kNone}});
    // The errors are a subset of the odometry's times, in the same order and with the same bits.
    if (error != paths.error.end() && error->time_s == sample.time_s) points.back().error = (error++)->pose;
  }
  return points;
}

std::vector<SeriesPoint> thin(std::vector<SeriesPoint> points, std::size_t most) {
  if (points.size() <= most) return points;
  std::vector<SeriesPoint> kept;
  kept.reserve(most);
  for (std::size_t i = 0; i < most; ++i) kept.push_back(points[i * (points.size() - 1) / (most - 1)]);
  return kept;
}

}  // namespace astro::report
