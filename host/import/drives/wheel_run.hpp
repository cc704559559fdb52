#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/import/drives/robot_geometry.hpp"
#include "host/import/drives/wheel_file.hpp"
#include "host/recording/run.hpp"

namespace astro::importing {

/// Samples in a second, from the first to the last.
template <class Sample>
double rate_hz(const std::vector<Sample>& samples) {
  const double span_s = 1e-9 * static_cast<double>(samples.back().time_ns - samples.front().time_ns);
  return span_s > 0 ? static_cast<double>(samples.size() - 1) / span_s : 0;
}

/// A drive of which only the wheels are known so far.
struct WheelRun {
  recording::Run run;           // dead reckoning with the factors of the geometry as odometry; no truth
  std::string summary;          // how many samples, how often
  std::vector<Remark> remarks;  // what was inferred or left out
};

/// Makes a run of a wheel track, with its gyro's yaw rate; imu_axis: as WheelSelection has it. Angles and metres of travel become counts with kAngleCounts in a turn
/// (analysis/trajectories.hpp).
///
/// Throws astro::Error if a wheel turns 100 times between two samples, or leaps faster than 20 m/s, and what
/// complete_geometry throws.
WheelRun run_of_wheels(const std::string& name, ImportedWheels wheels, const RobotGeometry& given,
                       const std::optional<std::array<double, 3>>& imu_axis = {});

}  // namespace astro::importing
