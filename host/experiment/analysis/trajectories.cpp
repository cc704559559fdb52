#include "host/experiment/analysis/trajectories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

#include "common/fixed/wrapping.hpp"
#include "host/base/error.hpp"
#include "host/base/utc.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/gyro_runs.hpp"
#include "host/experiment/analysis/loaded_parameter.hpp"
#include "host/experiment/files/same_number.hpp"

namespace astro::experiment {
namespace {

/// Distance since the first sample of a counter that wraps at 2^32.
class Travel {
 public:
  double advance(std::int32_t counts, double metres_per_count) {
    if (!first_) total_ += wrapping_difference(counts, seen_);
    first_ = false;
    seen_ = counts;
    return static_cast<double>(total_) * metres_per_count;
  }

 private:
  bool first_ = true;
  std::int32_t seen_ = 0;
  std::int64_t total_ = 0;
};

/// Keeps the first of several samples with the same time. Refuses a step back in time, which is a restart.
class Clock {
 public:
  Clock(std::int64_t origin_us, const std::string& run, const char* stream)
      : origin_us_(origin_us), run_(run), stream_(stream) {}

  bool advances(std::int64_t time_us) {
    if (any_ && time_us < last_us_)
      throw Error(fmt::format("the times of the {} in '{}' run backwards, as after a restart", stream_, run_),
                  AnalysisProblem::times_run_backwards, {run_, stream_});
    const bool later = !any_ || time_us > last_us_;
    any_ = true;
    last_us_ = time_us;
    return later;
  }
  double seconds() const { return static_cast<double>(last_us_ - origin_us_) * 1e-6; }

 private:
  std::int64_t origin_us_;
  const std::string& run_;
  const char* stream_;
  bool any_ = false;
  std::int64_t last_us_ = 0;
};

/// In seconds since 1970. Recordings of other origin have no date, but often count their times from 1970; times before the year 2000
/// count from any other moment.
std::optional<double> started_s(const recording::Run& run) {
  if (const auto started = utc_time(run.info.started_at))
    return 1e-6 * static_cast<double>(started->time_since_epoch().count());
  constexpr double kYear2000_s = 946'684'800;
  double latest_s = 1e-6 * static_cast<double>(run.odometry.front().time_us);
  if (!run.truth.empty())
    latest_s = std::max(latest_s, 1e-6 * static_cast<double>(run.truth.front().time_us));
  return latest_s < kYear2000_s ? std::nullopt : std::optional(latest_s);
}

}  // namespace

double NominalWheel::metres_per_count() const { return std::numbers::pi * diameter_m / counts_per_turn; }

bool NominalWheel::measures_like(const NominalWheel& other) const {
  if (turns_as_angle() || other.turns_as_angle()) return same_number(diameter_m / other.diameter_m, 1);
  return same_number(metres_per_count() / other.metres_per_count(), 1);
}

std::string NominalWheel::described() const {
  if (turns_as_angle()) return fmt::format("a wheel of {:.6g} m", diameter_m);
  return fmt::format("a wheel of {:.6g} m with {:.6g} counts a turn", diameter_m, counts_per_turn);
}

NominalWheel nominal_wheel(const recording::RunInfo& info, const std::string& name) {
  const auto loaded = [&](const char* parameter) { return loaded_parameter(info, parameter, name); };
  return {loaded("wheel_diameter"),
          loaded("counts_per_motor_rev") * loaded("gear_numerator") / loaded("gear_denominator")};
}

bool has_moving_truth(const recording::RunInfo& info) {
  return !info.truth_source.empty() && info.truth_source != "manual" &&
         info.truth_clock != "start and end of the run";
}

std::vector<calibration::WheelSample> wheels_of(const recording::Run& run, const std::string& name) {
  if (run.odometry.empty())
    throw Error(fmt::format("the recording '{}' holds no odometry", name), AnalysisProblem::no_odometry,
                {name});
  const double metres_per_count = nominal_wheel(run.info, name).metres_per_count();
  std::vector<calibration::WheelSample> wheels;
  Travel left, right;
  Clock robot(run.odometry.front().time_us, name, "odometry");
  for (const recording::OdometrySample& sample : run.odometry)
    if (robot.advances(sample.time_us))
      wheels.push_back({robot.seconds(), left.advance(sample.left_counts, metres_per_count),
                        right.advance(sample.right_counts, metres_per_count)});
  return wheels;
}

calibration::Trajectory trajectory_of(const recording::Run& run, const std::string& name) {
  if (!has_moving_truth(run.info))
    throw Error(
        fmt::format("nothing followed the robot while '{}' was recorded, and maximum likelihood needs that",
                    name),
        AnalysisProblem::run_without_truth, {name});
  calibration::Trajectory trajectory;
  trajectory.name = name;
  trajectory.wheels = wheels_of(run, name);
  trajectory.started_s = started_s(run);
  trajectory.wheel_turn_m = std::numbers::pi * nominal_wheel(run.info, name).diameter_m;
  Clock tracker(run.odometry.front().time_us, name, "ground truth");
  for (const recording::TruthSample& sample : run.truth)
    if (sample.valid && tracker.advances(sample.time_us))
      trajectory.truth.push_back({tracker.seconds(), sample.x_m, sample.y_m, sample.theta_rad});
  // Two that a tracker had not lost of a whole drive are no ends: the robot moved at their times.
  trajectory.ends_only = run.truth.size() == 2 && trajectory.truth.size() == 2;
  return trajectory;
}

std::vector<calibration::Trajectory> trajectories_of(const RunSet& set) {
  std::vector<calibration::Trajectory> trajectories;
  extend_trajectories(trajectories, set);
  return trajectories;
}

void extend_trajectories(std::vector<calibration::Trajectory>& trajectories, const RunSet& set) {
  if (trajectories.size() == set.runs.size()) return;
  for (std::size_t i = trajectories.size(); i < set.runs.size(); ++i) {
    calibration::Trajectory trajectory = trajectory_of(set.runs[i], set.names[i]);
    require_comparable(set.runs.front().info, set.names.front(), set.runs[i].info, set.names[i]);
    if (!set.sessions.empty()) trajectory.session = set.sessions[i];
    trajectories.push_back(std::move(trajectory));
  }
  add_slips(trajectories, set);
}

void require_comparable(const recording::RunInfo& a, const std::string& a_name, const recording::RunInfo& b,
                        const std::string& b_name) {
  if (a.robot_id != b.robot_id)
    throw Error(fmt::format("'{}' and '{}' were driven by different robots: calibrate each for itself",
                            a_name, b_name),
                AnalysisProblem::runs_of_different_robots, {a_name, b_name});
  if (nominal_wheel(a, a_name) != nominal_wheel(b, b_name))
    throw Error(
        fmt::format("'{}' and '{}' were driven with different wheel diameters, gears or encoders in the "
                    "parameters, to which c_R and c_L refer: calibrate each for itself",
                    a_name, b_name),
        AnalysisProblem::runs_of_different_wheels, {a_name, b_name});
}

}  // namespace astro::experiment
