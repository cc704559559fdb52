#include "host/calibration/prepared_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/base/error.hpp"
#include "host/calibration/path_alignment.hpp"
#include "host/calibration/wheel_path.hpp"

namespace astro::calibration {
namespace {

constexpr int kFewestSamples = 20;
// Less than either is a robot that was pushed, not driven.
constexpr double kShortestDrive_m = 0.2, kSmallestTurn_rad = 0.5;
constexpr double kLeastCorrelation = 0.5, kLeastLikeness = 0.9;
// Truth beyond the wheels' ends would be taken for standing still; half a clock's error is kept away from
// them.
constexpr double kMargin_s = 0.02;
constexpr double kWindow_s = 0.1;  // half of the time over which a motion is told
// Likewise for lines against arcs: a robot that is held on a line sways about it.
constexpr double kLongWindow_s = 0.5;
constexpr double kSlowest_mps = 0.002;

void require_samples(const Trajectory& run) {
  if (run.wheels.size() < 2) throw Error(run.name + " has no odometry: record it again");
  if (run.truth.size() < kFewestSamples)
    throw Error(
        fmt::format("{} has {} samples of ground truth: maximum likelihood needs the whole drive; take "
                    "--method umbmark or "
                    "extended for end poses alone",
                    run.name, run.truth.size()));
  const auto by_time = [](const auto& a, const auto& b) { return a.time_s < b.time_s; };
  if (!std::is_sorted(run.wheels.begin(), run.wheels.end(), by_time) ||
      !std::is_sorted(run.truth.begin(), run.truth.end(), by_time))
    throw Error(run.name + " has times that run backwards: record it again");
}

/// What the centre travelled and how far the robot turned within so much of a moment.
MotionExtent extent_around(const WheelPath& path, double time_s, double half_window_s, double wheelbase_m) {
  const WheelState a = path.at(time_s - half_window_s), b = path.at(time_s + half_window_s);
  const double left = b.left_m - a.left_m, right = b.right_m - a.right_m;
  return {std::abs(left + right) / 2, std::abs(right - left) / wheelbase_m};
}

Motion motion_at(const WheelPath& path, double time_s, double wheelbase_m) {
  const MotionExtent now = extent_around(path, time_s, kWindow_s, wheelbase_m);
  if (now.distance_m + now.rotation_rad * wheelbase_m / 2 < 2 * kWindow_s * kSlowest_mps) return Motion::rest;
  if (now.distance_m < now.rotation_rad * wheelbase_m / 4) return Motion::spin;
  const MotionExtent longer = extent_around(path, time_s, kLongWindow_s, wheelbase_m);
  return longer.distance_m > 10 * wheelbase_m * longer.rotation_rad ? Motion::line : Motion::arc;
}

bool mostly_headings(const Trajectory& run) {
  const auto with = std::count_if(run.truth.begin(), run.truth.end(),
                                  [](const BodySample& sample) { return std::isfinite(sample.theta_rad); });
  return 2 * static_cast<std::size_t>(with) > run.truth.size();
}

double median_period_s(const std::vector<WheelSample>& wheels) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < wheels.size(); ++i) periods.push_back(wheels[i].time_s - wheels[i - 1].time_s);
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
}

PreparedRun cropped(const Trajectory& run, const ClockFit& clock, Density density) {
  PreparedRun prepared;
  prepared.source = &run;
  prepared.has_headings = mostly_headings(run);
  prepared.clock_middle_s = (run.wheels.front().time_s + run.wheels.back().time_s) / 2 - clock.offset_s;
  // A hair less, so that a multiple of the tracker's period is not missed by its jitter.
  const double spacing_s = density == Density::all ? 0 : 0.9 * median_period_s(run.wheels);
  double last_s = -std::numeric_limits<double>::infinity();
  for (const BodySample& sample : run.truth) {
    if (!std::isfinite(sample.x_m) || !std::isfinite(sample.y_m)) continue;
    if (prepared.has_headings && !std::isfinite(sample.theta_rad)) continue;
    // Before the clock has its say: which samples are taken must not hang on where a search found it.
    if (sample.time_s - last_s < spacing_s) continue;
    last_s = sample.time_s;
    const double u = clock.robot_time_s(sample.time_s, prepared.clock_middle_s);
    if (u < run.wheels.front().time_s + kMargin_s || u > run.wheels.back().time_s - kMargin_s) continue;
    prepared.truth.push_back(sample);
  }
  return prepared;
}

void tell_motion(PreparedRun& run, const ClockFit& clock, double wheelbase_m) {
  const WheelPath path(run.source->wheels);
  WheelState before;
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const double u = clock.robot_time_s(run.truth[i].time_s, run.clock_middle_s);
    run.motion.push_back(motion_at(path, u, wheelbase_m));
    const WheelState now = path.at(u);
    if (i > 0) {
      const double distance_m = std::abs(now.left_m - before.left_m + now.right_m - before.right_m) / 2;
      const double turn_rad =
          std::abs((now.right_m - before.right_m) - (now.left_m - before.left_m)) / wheelbase_m;
      MotionExtent& extent = run.extent[static_cast<std::size_t>(run.motion[i])];
      extent.distance_m += distance_m;
      extent.rotation_rad += turn_rad;
    }
    before = now;
  }
  for (const MotionExtent& extent : run.extent) run.distance_m += extent.distance_m;
  // Counts that flicker on a line are no turning.
  for (const Motion motion : {Motion::arc, Motion::spin})
    run.rotation_rad += run.extent[static_cast<std::size_t>(motion)].rotation_rad;
}

void require_motion(const PreparedRun& run) {
  if (run.truth.size() < kFewestSamples)
    throw Error(
        fmt::format("{}: only {} samples of ground truth fall into the time of the drive: check that both "
                    "were recorded together",
                    run.source->name, run.truth.size()));
  if (run.distance_m < kShortestDrive_m && run.rotation_rad < kSmallestTurn_rad)
    throw Error(
        fmt::format("{} is too short: {:.2f} m and {:.0f} degrees under ground truth; drive at least a metre "
                    "or a turn, or leave it out",
                    run.source->name, run.distance_m, run.rotation_rad * 180 / std::numbers::pi));
}

struct HeadingChange {
  double product = 0, truth = 0, wheels = 0;
};

HeadingChange heading_change(const PreparedRun& run, const std::vector<BodySample>& odometry) {
  // Steps that stand out of the noise and are far below half a turn.
  constexpr double kStep_s = 0.2;
  HeadingChange sums;
  for (std::size_t i = 0, from = 0; i < run.truth.size(); ++i) {
    if (run.truth[i].time_s - run.truth[from].time_s < kStep_s) continue;
    const double truth =
        std::remainder(run.truth[i].theta_rad - run.truth[from].theta_rad, 2 * std::numbers::pi);
    const double wheels = odometry[i].theta_rad - odometry[from].theta_rad;
    from = i;
    if (std::abs(wheels) > 2.5) continue;  // a long gap
    sums.product += truth * wheels;
    sums.truth += std::abs(truth);
    sums.wheels += std::abs(wheels);
  }
  return sums;
}

[[noreturn]] void refuse_opposite_turn(const std::string& name, bool positions_agree) {
  if (positions_agree)
    throw Error(name +
                ": the headings of the ground truth turn right where its positions and the wheels turn left: "
                "they are "
                "clockwise; negate them");
  throw Error(
      name +
      ": the ground truth turns right where the wheels say left: either its axes are mirrored (a Y-up export "
      "has x = Z, y = X) or the left and right wheels are exchanged; 'astrolabe check-wiring' tells which");
}

void require_senses(const PreparedRun& run, const ClockFit& clock, const WheelFactors& carried) {
  const std::vector<BodySample> odometry = dead_reckoned(run, clock, carried);
  const double straight_m = fit_rigid(odometry, run.truth, false).rms_m;
  const double mirrored_m = fit_rigid(odometry, run.truth, true).rms_m;
  // A line is its own mirror image; so is nearly a spin on the spot.
  const bool positions_oppose = run.distance_m > 1 && straight_m > 0.05 && mirrored_m < straight_m / 3;
  if (run.has_headings && run.rotation_rad > 1) {
    const HeadingChange change = heading_change(run, odometry);
    if (change.truth < 0.2 * change.wheels)
      throw Error(
          fmt::format("{}: the wheels turned the robot by {:.0f} degrees and the heading of the ground truth "
                      "stayed: export the orientation of the body, too, or leave the headings out",
                      run.source->name, run.rotation_rad * 180 / std::numbers::pi));
    if (change.product < 0) refuse_opposite_turn(run.source->name, !positions_oppose);
  }
  if (positions_oppose) refuse_opposite_turn(run.source->name, false);
}

}  // namespace

PreparedRuns prepare(std::span<const Trajectory> runs, const WheelFactors& carried, bool clock_known,
                     Density density) {
  if (runs.empty()) throw Error("there are no runs to calibrate from");
  PreparedRuns prepared;
  std::optional<double> skew;
  for (const Trajectory& run : runs) {
    require_samples(run);
    ClockFit clock;
    if (!clock_known) {
      clock = search_clock(run, carried.b_m, skew);
      if (clock.correlation < kLeastCorrelation && clock.likeness < kLeastLikeness)
        throw Error(
            run.name +
            ": the motions of wheels and ground truth have nothing in common at any offset of their clocks: "
            "check that they belong to the same drive");
      skew = clock.skew;
    }
    PreparedRun ready = cropped(run, clock, density);
    tell_motion(ready, clock, carried.b_m);
    require_motion(ready);
    require_senses(ready, clock, carried);
    prepared.runs.push_back(std::move(ready));
    prepared.clocks.push_back(clock);
  }
  return prepared;
}

}  // namespace astro::calibration
