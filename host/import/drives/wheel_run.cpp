#include "host/import/drives/wheel_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/microseconds.hpp"
#include "host/calibration/motion/arc.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/experiment/analysis/trajectories.hpp"
#include "host/import/drives/yaw_axis.hpp"

namespace astro::importing {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;

bool whole_counts(const WheelTrack& track) {
  return track.unit == WheelUnit::counts &&
         std::all_of(track.samples.begin(), track.samples.end(), [](const WheelSample& sample) {
           return std::round(sample.left) == sample.left && std::round(sample.right) == sample.right;
         });
}

/// Converts the travel of a track to counts of a nominal wheel.
struct Counter {
  experiment::NominalWheel wheel;
  double counts_per_unit = 1;

  Counter(const WheelTrack& track, const RobotGeometry& geometry)
      : wheel{*geometry.wheel_diameter_m, experiment::kAngleCounts} {
    switch (track.unit) {
      case WheelUnit::counts:
        counts_per_unit = experiment::kAngleCounts / *geometry.counts_per_turn;
        if (whole_counts(track)) {
          wheel.counts_per_turn = *geometry.counts_per_turn;
          counts_per_unit = 1;
        }
        break;
      case WheelUnit::radians:
        counts_per_unit = experiment::kAngleCounts / kTurn_rad;
        break;
      case WheelUnit::metres:
        counts_per_unit = 1 / wheel.metres_per_count();
        break;
    }
  }

  std::int64_t counts(double travel) const { return std::llround(travel * counts_per_unit); }
};

/// Refuses a step of more than a hundred wheel turns, which is too long for a gap in the recording. Refuses a
/// step faster than 20 m/s, which no robot drives: a counter was restarted. Short steps may be faster,
/// because a recorder may give many samples that it received late the same time.
void refuse_leaps(const std::string& name, const WheelTrack& track, const Counter& counter) {
  constexpr double kMostTurns = 100, kMost_mps = 20, kAtOnce_m = 0.5;
  for (std::size_t i = 1; i < track.samples.size(); ++i) {
    const WheelSample &from = track.samples[i - 1], &to = track.samples[i];
    const double most = std::max(std::abs(to.left - from.left), std::abs(to.right - from.right));
    const double counts = most * counter.counts_per_unit;
    const double from_s = 1e-9 * static_cast<double>(from.time_ns),
                 to_s = 1e-9 * static_cast<double>(to.time_ns);
    const double way_m = counts * counter.wheel.metres_per_count();
    const bool too_far = !(counts < kMostTurns * counter.wheel.counts_per_turn);
    if (!too_far && !(way_m > kAtOnce_m + kMost_mps * (to_s - from_s))) continue;
    const std::string before = fmt::format("{:.3f}", from_s), after = fmt::format("{:.3f}", to_s),
                      way = fmt::format("{:.2f}", way_m);
    if (too_far)
      throw Error(fmt::format("'{}': a wheel turns more than {} times between the samples at {} s and {} s",
                              name, kMostTurns, before, after),
                  ImportProblem::turns_too_far, {name, before, after});
    throw Error(
        fmt::format("'{}': a wheel leaps by {} m between the samples at {} s and {} s, as where a counter "
                    "starts again",
                    name, way, before, after),
        ImportProblem::leaps, {name, way, before, after});
  }
}

/// Takes ownership of the samples, so that they are freed as they are converted: an hour at 1 kHz has 90 MB of them, and
/// twice as much odometry.
std::vector<recording::OdometrySample> odometry_of(std::vector<WheelSample> samples, const Counter& counter,
                                                   const RobotGeometry& geometry) {
  std::vector<recording::OdometrySample> odometry;
  odometry.reserve(samples.size());
  const calibration::WheelFactors factors = geometry.factors();
  const double count_m = counter.wheel.metres_per_count();
  const WheelSample start = samples.front();  // a counter may start at any number
  recording::OdometrySample sample;
  Pose2 pose;
  std::int64_t left = 0, right = 0;
  std::ranges::reverse(samples);
  const std::size_t half = samples.size() / 2;
  for (; !samples.empty(); samples.pop_back()) {
    if (samples.size() == half) samples.shrink_to_fit();
    const WheelSample& at = samples.back();
    const std::int64_t new_left = counter.counts(at.left - start.left),
                       new_right = counter.counts(at.right - start.right);
    const std::int64_t time_us = whole_microseconds(at.time_ns);
    const double right_step_m = count_m * static_cast<double>(new_right - right),
                 left_step_m = count_m * static_cast<double>(new_left - left);
    calibration::advance(pose, right_step_m, left_step_m, factors);
    if (!odometry.empty() && time_us > sample.time_us) {
      const double dt_s = 1e-6 * static_cast<double>(time_us - sample.time_us);
      sample.v_mps = (factors.c_r * right_step_m + factors.c_l * left_step_m) / 2 / dt_s;
      sample.omega_radps = (pose.theta_rad - sample.theta_rad) / dt_s;
    }
    left = new_left;
    right = new_right;
    sample.time_us = time_us;
    sample.x_m = pose.x_m;
    sample.y_m = pose.y_m;
    sample.theta_rad = pose.theta_rad;
    sample.left_counts = static_cast<std::int32_t>(static_cast<std::uint32_t>(left));
    sample.right_counts = static_cast<std::int32_t>(static_cast<std::uint32_t>(right));
    odometry.push_back(sample);
  }
  return odometry;
}

recording::RunInfo info_of(const ImportedWheels& wheels, const Counter& counter,
                           const RobotGeometry& geometry) {
  recording::RunInfo info = wheels.info.value_or(recording::RunInfo{});
  if (wheels.info) return info;
  info.kind = "free";
  info.robot_name = geometry.name;
  info.robot_id = geometry.id;
  info.parameters = {{"wheel_diameter", counter.wheel.diameter_m},
                     {"counts_per_motor_rev", counter.wheel.counts_per_turn},
                     {"gear_numerator", 1},
                     {"gear_denominator", 1},
                     {"c_R", geometry.c_r},
                     {"c_L", geometry.c_l},
                     {"b", *geometry.wheelbase_m},
                     {"e", geometry.e},
                     {"kappa0", geometry.kappa0}};
  return info;
}

/// The geometry in our own recording takes precedence over what is stated about the robot.
RobotGeometry geometry_of(const ImportedWheels& wheels, const RobotGeometry& given, const std::string& name) {
  if (!wheels.info) return complete_geometry(given, wheels.track.unit);
  const experiment::NominalWheel wheel = experiment::nominal_wheel(*wheels.info, name);
  const calibration::WheelFactors loaded = experiment::loaded_factors(*wheels.info, name);
  RobotGeometry geometry;
  geometry.wheel_diameter_m = wheel.diameter_m;
  geometry.counts_per_turn = wheel.counts_per_turn;
  geometry.wheelbase_m = loaded.b_m;
  geometry.c_r = loaded.c_r;
  geometry.c_l = loaded.c_l;
  geometry.e = loaded.e;
  geometry.kappa0 = loaded.kappa0;
  return geometry;
}

/// Adds a remark if sizes were given that differ from those in the recording.
void remark_on_unused(const RobotGeometry& given, const RobotGeometry& used, std::vector<Remark>& remarks) {
  constexpr double kSame = 1e-6;
  const auto differs = [](const std::optional<double>& value, const std::optional<double>& own) {
    return value && std::abs(*value / *own - 1) > kSame;
  };
  if (!differs(given.wheel_diameter_m, used.wheel_diameter_m) &&
      !differs(given.counts_per_turn, used.counts_per_turn) && !differs(given.wheelbase_m, used.wheelbase_m))
    return;
  remarks.push_back(
      {fmt::format("its own recording knows the robot (wheels of {:.4g} m, {:.6g} counts per turn, wheelbase "
                   "{:.4g} m), and the sizes that were given are not used",
                   *used.wheel_diameter_m, *used.counts_per_turn, *used.wheelbase_m),
       ImportProblem::sizes_not_used});
}

/// Reverses joints that turn backward when the robot drives forward.
void turn_forward(const std::string& name, const RobotGeometry& given, WheelTrack& track) {
  if (!given.left_backward && !given.right_backward) return;
  for (WheelSample& sample : track.samples) {
    if (given.left_backward) sample.left = -sample.left;
    if (given.right_backward) sample.right = -sample.right;
  }
  const std::string side = !given.left_backward ? "right" : given.right_backward ? "both" : "left";
  track.remarks.push_back(
      {"a multiplier below zero: the joint of the " +
           (side == "both" ? "left wheel and that of the right one turn" : side + " wheel turns") +
           " backward when the robot drives forward, and was reversed",
       ImportProblem::joints_backward,
       {name, side}});
}

std::string summary_of(const std::vector<WheelSample>& counts) {
  return fmt::format("{} samples of the wheels at {:.4g} Hz over {:.1f} s", counts.size(), rate_hz(counts),
                     1e-9 * static_cast<double>(counts.back().time_ns - counts.front().time_ns));
}

}  // namespace

WheelRun run_of_wheels(const std::string& name, ImportedWheels wheels, const RobotGeometry& given,
                       const std::optional<std::array<double, 3>>& imu_axis) {
  if (given.open_loop && !wheels.track.odometry.empty())
    throw Error("'" + name + "': the controller makes its odometry " + wheels.track.odometry +
                    " of commands (open_loop: true), not of the wheels: record what the encoders say, such "
                    "as the states of "
                    "the joints",
                ImportProblem::odometry_of_commands, {wheels.track.odometry});
  if (wheels.track.odometry.empty() && !wheels.info) turn_forward(name, given, wheels.track);
  const RobotGeometry geometry = geometry_of(wheels, given, name);
  const Counter counter(wheels.track, geometry);
  refuse_leaps(name, wheels.track, counter);
  WheelRun made;
  made.remarks = wheels.track.remarks;
  if (wheels.info) remark_on_unused(given, geometry, made.remarks);
  made.run.info = info_of(wheels, counter, geometry);
  made.summary = summary_of(wheels.track.samples);
  made.run.odometry = odometry_of(std::move(wheels.track.samples), counter, geometry);
  made.run.yaw_rates = yaw_rates_of(std::move(wheels.imu), made.run.odometry, imu_axis, made.remarks);
  made.run.gyro = std::move(wheels.gyro);
  made.run.slips = std::move(wheels.slips);
  return made;
}

}  // namespace astro::importing
