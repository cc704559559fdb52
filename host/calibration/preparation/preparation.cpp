#include "host/calibration/preparation/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/order_statistics.hpp"
#include "host/base/text/degrees.hpp"
#include "host/calibration/motion/clock_step.hpp"
#include "host/calibration/motion/stamp_leap.hpp"
#include "host/calibration/motion/tracker_noise.hpp"
#include "host/calibration/motion/wheel_path.hpp"
#include "host/calibration/preparation/handedness.hpp"
#include "host/calibration/preparation/preparation_problem.hpp"
#include "host/calibration/preparation/sessions.hpp"
#include "host/calibration/preparation/slips.hpp"
#include "host/calibration/preparation/wheel_way.hpp"

namespace astro::calibration {
namespace {

constexpr int kFewestSamples = 20;
constexpr double kLongestPause_s = 3600;
// A cubic follows a moving robot over shorter gaps of odometry, or over one and a half of its usual periods. A standing robot
// may have longer ones.
constexpr double kLongestWheelGap_s = 0.3, kLongestGapPeriods = 1.6, kWheelGapMotion_m = 0.01;
// After a gap a robot that went straight ahead is where its wheels say, to a tenth of the way.
constexpr double kUnknownPart = 0.1;
// With more of its way in gaps a drive is no recording of one.
constexpr double kMostInGaps = 0.5;
// At longer periods the wheels' path is known at their samples far better than between them.
constexpr double kSlowLog_s = 0.15;
// At longer periods a robot may drive, turn on the spot and drive on between two samples, which no cubic shows: the position
// behind such a turn is not known. At 0.5 s the errors are those that are due, at 0.7 s three times as large (tests/host/
// calibration/preparation/odd_logs_test.cpp, 16 sets of squares). A turn below kStraight_rad bends no way noticeably.
constexpr double kSlowestFollowed_s = 0.6, kStraight_rad = 0.03;
// A drive with less than both was a push, not a drive.
constexpr double kShortestDrive_m = 0.2, kSmallestTurn_rad = 0.5;
constexpr double kLeastCorrelation = 0.5, kLeastLikeness = 0.9;
// A run is first tried with the skew of the run before. If its correlation is below kSurelyRight, or below that of the run
// before by more than kNotWorse, its clock may have been reset, and its skew is searched anew.
constexpr double kSurelyRight = 0.9, kNotWorse = 0.04;
// Truth beyond the ends of the odometry would count as standing still, so truth within the error of the clock
// offset from these ends is not used.
constexpr double kMargin_s = 0.02;
constexpr double kWindow_s = 0.1;  // half of the window in which a motion is classified
// The window that separates lines from arcs, because a robot that is controlled along a line sways about it.
constexpr double kLongWindow_s = 0.5;
// Mean speed over the window. The robot's own limit (common/safety/wheel_stopped.hpp) is for the speed that it observes,
// which jumps to several mm/s at a single count; here one count in the window is 0.4 mm/s (reference robot).
constexpr double kSlowest_mps = 0.002;

// Checks the times of one stream.
template <class Sample>
void require_times(const std::string& name, const char* stream, const std::vector<Sample>& samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!std::isfinite(samples[i].time_s))
      throw Error(fmt::format("{} has {} without a time: record it again", name, stream),
                  PreparationProblem::times_missing, {name, stream});
    const double step_s = i > 0 ? samples[i].time_s - samples[i - 1].time_s : 0;
    if (step_s < 0)
      throw Error(fmt::format("{} has {} whose times run backwards: record it again", name, stream),
                  PreparationProblem::times_run_backwards, {name, stream});
    if (step_s > kLongestPause_s)
      throw Error(fmt::format("{} has {} that jumps by {:.0f} s: two recordings in one, or a clock that was "
                              "set; cut it there",
                              name, stream, step_s),
                  PreparationProblem::times_jump, {name, stream});
  }
}

void require_wheels(const Trajectory& run) {
  if (run.wheels.size() < kFewestSamples)
    throw Error(fmt::format("{} has {} samples of odometry, and {} are the fewest: record it again", run.name,
                            run.wheels.size(), kFewestSamples),
                PreparationProblem::too_little_odometry, {run.name, std::to_string(run.wheels.size())});
  require_times(run.name, "odometry", run.wheels);
  for (std::size_t i = 0; i < run.wheels.size(); ++i) {
    const WheelSample& now = run.wheels[i];
    if (!std::isfinite(now.left_m) || !std::isfinite(now.right_m))
      throw Error(run.name + " has odometry that is no number: record it again",
                  PreparationProblem::odometry_not_finite, {run.name});
  }
}

void require_samples(const Trajectory& run, bool clock_known) {
  if (run.wheels.size() < 2)
    throw Error(run.name + " has no odometry: record it again", PreparationProblem::no_odometry, {run.name});
  const auto finite = std::count_if(run.truth.begin(), run.truth.end(), [](const BodySample& sample) {
    return std::isfinite(sample.x_m) && std::isfinite(sample.y_m);
  });
  const bool both_ends = clock_known && run.ends_only && finite == 2;
  if (finite < kFewestSamples && !both_ends)
    throw Error(fmt::format("{} has {} samples of ground truth, and maximum likelihood needs the whole drive",
                            run.name, finite),
                PreparationProblem::too_little_truth, {run.name, std::to_string(finite)});
  require_wheels(run);
  if (!run.ends_only) require_times(run.name, "ground truth", run.truth);
}

/// Travel of the centre and rotation between two moments, by roughly right factors.
MotionExtent extent_between(const WheelState& a, const WheelState& b, const WheelFactors& factors) {
  const double left = factors.c_l * (b.left_m - a.left_m), right = factors.c_r * (b.right_m - a.right_m);
  return {std::abs(left + right) / 2, std::abs(right - left) / factors.b_m};
}

/// A gap of odometry that is longer is one in which samples were lost.
double longest_period_s(const Trajectory& run) {
  return std::max(kLongestWheelGap_s, kLongestGapPeriods * median_period_s(run.wheels));
}

/// The gaps of a drive's odometry, and the turns of one whose wheels were logged so seldom that the way between two samples is
/// not known. Throws astro::Error if most of the drive is in gaps.
std::vector<WheelGap> gaps_of(const Trajectory& run, double wheelbase_m) {
  const double longest_s = longest_period_s(run);
  const bool seldom = median_period_s(run.wheels) > kSlowestFollowed_s;
  std::vector<WheelGap> gaps;
  double way_m = 0, in_gaps_m = 0, in_gaps_s = 0;
  for (std::size_t i = 1; i < run.wheels.size(); ++i) {
    const WheelSample &before = run.wheels[i - 1], &now = run.wheels[i];
    const double left_m = now.left_m - before.left_m, right_m = now.right_m - before.right_m;
    const double moved_m = std::max(std::abs(left_m), std::abs(right_m));
    way_m += moved_m;
    const bool lost = now.time_s - before.time_s > longest_s;
    const double turn_rad = std::abs(right_m - left_m) / wheelbase_m;
    if (moved_m <= kWheelGapMotion_m || !(lost || (seldom && turn_rad > kStraight_rad))) continue;
    const double unknown_m = moved_m * std::min(1.0, (lost ? kUnknownPart : 0) + turn_rad / 2);
    gaps.push_back({before.time_s, now.time_s, unknown_m * unknown_m});
    if (!lost) continue;
    in_gaps_m += moved_m;
    in_gaps_s += now.time_s - before.time_s;
  }
  if (in_gaps_m > kMostInGaps * way_m)
    throw Error(
        fmt::format("{} lost its odometry for {:.1f} s while the robot moved by {:.2f} m of {:.2f} m on an "
                    "unknown path: leave it out, or record it again",
                    run.name, in_gaps_s, in_gaps_m, way_m),
        PreparationProblem::odometry_lost, {run.name});
  return gaps;
}

/// Says that there are gaps, of which only the ends are used.
void say_bridged(const Trajectory& run, std::span<const WheelGap> gaps, std::vector<Remark>& mended) {
  const double period_s = median_period_s(run.wheels), longest_s = longest_period_s(run);
  double lost_s = 0;
  int lost = 0;
  for (const WheelGap& gap : gaps) {
    if (gap.end_s - gap.begin_s <= longest_s) continue;
    lost_s += gap.end_s - gap.begin_s;
    ++lost;
  }
  const std::string count = std::to_string(lost), seconds = fmt::format("{:.1f}", lost_s),
                    period = fmt::format("{:.2g}", period_s);
  if (lost > 0)
    mended.push_back({fmt::format("{} lost its odometry {} for {} s in all while the robot moved: its "
                                  "heading goes on by the counts "
                                  "after it, its place there is taken from the ground truth",
                                  run.name, lost == 1 ? "once" : count + " times", seconds),
                      PreparationProblem::odometry_bridged,
                      {run.name, count, seconds}});
  if (period_s > kSlowestFollowed_s)
    mended.push_back(
        {fmt::format("{} has its wheels only every {} s: where it turns in between, its place is "
                     "taken from the ground truth; log them five times a second or more often",
                     run.name, period),
         PreparationProblem::odometry_seldom,
         {run.name, period}});
}

/// Of truth at a high rate, those samples that are next to a sample of a slow log of wheels.
class NextToWheels {
 public:
  explicit NextToWheels(std::span<const WheelSample> wheels) : wheels_(wheels) {}

  /// The truth sample that is nearest to a wheel sample, once it is known; of the samples with this time and those before.
  std::optional<BodySample> take(const BodySample& sample, double robot_time_s) {
    while (next_ + 1 < wheels_.size() && std::abs(wheels_[next_ + 1].time_s - robot_time_s) <=
                                             std::abs(wheels_[next_].time_s - robot_time_s))
      ++next_;
    std::optional<BodySample> settled;
    if (best_ && at_ != next_) settled = std::exchange(best_, {});
    const double apart_s = std::abs(wheels_[next_].time_s - robot_time_s);
    if (!best_ || apart_s < apart_s_) {
      best_ = sample;
      apart_s_ = apart_s;
      at_ = next_;
    }
    return settled;
  }
  const std::optional<BodySample>& last() const { return best_; }

 private:
  std::span<const WheelSample> wheels_;
  std::size_t next_ = 0, at_ = 0;
  double apart_s_ = 0;
  std::optional<BodySample> best_;
};

/// The motion of the wheels within half_window_s of a moment. Each end has its own path, because a path finds times near its
/// last one without a search.
class Around {
 public:
  Around(std::span<const WheelSample> wheels, double half_window_s)
      : begin_(wheels), end_(wheels), half_window_s_(half_window_s) {}

  MotionExtent operator()(double time_s, const WheelFactors& factors) const {
    return extent_between(begin_.at(time_s - half_window_s_), end_.at(time_s + half_window_s_), factors);
  }

 private:
  WheelPath begin_, end_;
  double half_window_s_;
};

Motion motion_at(const Around& near, const Around& wide, double time_s, const WheelFactors& factors) {
  const double wheelbase_m = factors.b_m;
  const MotionExtent now = near(time_s, factors);
  if (now.distance_m + now.rotation_rad * wheelbase_m / 2 < 2 * kWindow_s * kSlowest_mps) return Motion::rest;
  if (now.distance_m < now.rotation_rad * wheelbase_m / 4) return Motion::spin;
  const MotionExtent longer = wide(time_s, factors);
  return longer.distance_m > 10 * wheelbase_m * longer.rotation_rad ? Motion::line : Motion::arc;
}

PreparedRun cropped(const Trajectory& run, const ClockFit& clock, double wheelbase_m, Density density) {
  PreparedRun prepared;
  prepared.source = &run;
  prepared.has_headings = mostly_headings(run.truth);
  prepared.clock_middle_s = (run.wheels.front().time_s + run.wheels.back().time_s) / 2 - clock.offset_s;
  prepared.gaps = gaps_of(run, wheelbase_m);
  if (!run.slips.empty()) prepared.gaps = joined(std::move(prepared.gaps), gaps_of_slips(run));
  if (run.ends_only) {
    prepared.truth = run.truth;
    prepared.truth.front().time_s = run.wheels.front().time_s + kMargin_s;
    prepared.truth.back().time_s = run.wheels.back().time_s - kMargin_s;
    return prepared;
  }
  const double period_s = median_period_s(run.wheels);
  // Slightly less than the wheels' period, so that a sample that is late or early by jitter is not skipped.
  const double spacing_s = density == Density::all ? 0 : 0.9 * period_s;
  const bool slow = density == Density::independent && period_s > kSlowLog_s;
  NextToWheels next_to_wheels(run.wheels);
  auto gap = prepared.gaps.begin();
  double last_s = -std::numeric_limits<double>::infinity();
  for (const BodySample& sample : run.truth) {
    if (!std::isfinite(sample.x_m) || !std::isfinite(sample.y_m)) continue;
    if (prepared.has_headings && !std::isfinite(sample.theta_rad)) continue;
    // Compares the tracker's own times, because the selection of samples must not depend on the estimated
    // clock offset.
    if (!slow && sample.time_s - last_s < spacing_s) continue;
    last_s = sample.time_s;
    const double u = clock.robot_time_s(sample.time_s, prepared.clock_middle_s);
    if (u < run.wheels.front().time_s + kMargin_s || u > run.wheels.back().time_s - kMargin_s) continue;
    while (gap != prepared.gaps.end() && gap->end_s - kMargin_s <= u) ++gap;
    if (gap != prepared.gaps.end() && gap->begin_s + kMargin_s < u) continue;
    if (!slow) {
      prepared.truth.push_back(sample);
    } else if (const auto settled = next_to_wheels.take(sample, u)) {
      prepared.truth.push_back(*settled);
    }
  }
  if (next_to_wheels.last()) prepared.truth.push_back(*next_to_wheels.last());
  return prepared;
}

/// Sum of the net rotation of each second: includes arcs of any radius, excludes counts that flicker on a line.
double net_rotation_rad(const PreparedRun& run, std::span<const WheelState> wheels,
                        const WheelFactors& factors) {
  double sum_rad = 0;
  WheelState before;
  for (std::size_t i = 0, from = 0; i < run.truth.size(); ++i) {
    const WheelState& now = wheels[i];
    if (i == 0) before = now;
    if (run.truth[i].time_s - run.truth[from].time_s < 1 && i + 1 < run.truth.size()) continue;
    sum_rad += extent_between(before, now, factors).rotation_rad;
    from = i;
    before = now;
  }
  return sum_rad;
}

void classify_motion(PreparedRun& run, std::span<const WheelState> wheels, const ClockFit& clock,
                     const WheelFactors& factors) {
  const Around near(run.source->wheels, kWindow_s), wide(run.source->wheels, kLongWindow_s);
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const double u = clock.robot_time_s(run.truth[i].time_s, run.clock_middle_s);
    run.motion.push_back(motion_at(near, wide, u, factors));
    if (i == 0) continue;
    const MotionExtent moved = extent_between(wheels[i - 1], wheels[i], factors);
    MotionExtent& extent = run.extent[static_cast<std::size_t>(run.motion[i])];
    extent.distance_m += moved.distance_m;
    extent.rotation_rad += moved.rotation_rad;
  }
  for (const MotionExtent& extent : run.extent) run.distance_m += extent.distance_m;
  run.rotation_rad = net_rotation_rad(run, wheels, factors);
}

void require_motion(const PreparedRun& run) {
  if (run.truth.size() < kFewestSamples && !run.source->ends_only)
    throw Error(
        fmt::format("{}: only {} samples of ground truth fall into the time of the drive: check that both "
                    "were recorded together",
                    run.source->name, run.truth.size()),
        PreparationProblem::hardly_overlap, {run.source->name, std::to_string(run.truth.size())});
  if (run.distance_m < kShortestDrive_m && run.rotation_rad < kSmallestTurn_rad)
    throw Error(
        fmt::format("{} is too short: {:.2f} m and {:.0f} degrees under ground truth; drive at least a metre "
                    "or a turn, or leave it out",
                    run.source->name, run.distance_m, degrees(run.rotation_rad)),
        PreparationProblem::too_short, {run.source->name});
}

/// `before`: the clock of the run before; its skew is used if it fits.
ClockFit clock_of(const Trajectory& run, const WheelFactors& loaded, const std::optional<ClockFit>& before) {
  if (!before) return search_clock(run, loaded.b_m, {});
  const ClockFit clock = search_clock(run, loaded.b_m, before->skew);
  if (clock.correlation >= std::max(kSurelyRight, before->correlation - kNotWorse)) return clock;
  const ClockFit anew = search_clock(run, loaded.b_m, {});
  return anew.correlation > clock.correlation ? anew : clock;
}

bool in_common(const ClockFit& clock) {
  return clock.correlation >= kLeastCorrelation || clock.likeness >= kLeastLikeness;
}

/// A spin during which the positions of the body stand still, because it sits on the axis.
bool is_blind_spin(const Trajectory& run, const ClockFit& clock, double wheelbase_m) {
  if (mostly_headings(run.truth) || in_common(clock)) return false;
  double distance_m = 0, turned_m = 0;
  for (std::size_t i = 1; i < run.wheels.size(); ++i) {
    const double left = run.wheels[i].left_m - run.wheels[i - 1].left_m;
    const double right = run.wheels[i].right_m - run.wheels[i - 1].right_m;
    distance_m += std::abs(left + right) / 2;
    turned_m += std::abs(right - left) / 2;
  }
  return turned_m > kSmallestTurn_rad * wheelbase_m / 2 && distance_m < turned_m / 4;
}

Remark why_blind(const Trajectory& run) {
  return {
      run.name +
          " turned on the spot under positions that stand still, which determine neither its clock "
          "nor how far it turned: export the orientation of the body, too, or mount it away from the axis",
      PreparationProblem::positions_stay,
      {run.name}};
}

const char* in_words(StampedStream stream) {
  return stream == StampedStream::odometry ? "odometry" : "ground truth";
}

Remark why_retimed(const Trajectory& run, const StampLeap& leap) {
  const double at_s = leap.stream == StampedStream::odometry
                          ? run.wheels[leap.after].time_s - run.wheels.front().time_s
                          : run.truth[leap.after].time_s - run.truth.front().time_s;
  const std::string stream = in_words(leap.stream), by = fmt::format("{:.2f}", leap.by_s),
                    at = fmt::format("{:.1f}", at_s);
  return {fmt::format(
              "the clock of the {} of {} was set on by {} s at {} s: what follows was set back by as much",
              stream, run.name, by, at),
          PreparationProblem::clock_stepped,
          {run.name, stream, by, at}};
}

Remark why_step_hidden(const Trajectory& run, const ClockStep& step) {
  const std::string by = fmt::format("{:.2f}", step.by_s),
                    from = fmt::format("{:.1f}", step.begin_s - run.truth.front().time_s),
                    to = fmt::format("{:.1f}", step.end_s - run.truth.front().time_s);
  return {
      fmt::format(
          "by the motion the odometry of {} is {} s later against the ground truth from some moment between "
          "{} s and {} s on, and no stamps show it: a clock was set anew, or the drive repeats itself and "
          "was recorded in part; cut it there, or record it again from rest to rest with clocks that "
          "nothing sets",
          run.name, by, from, to),
      PreparationProblem::clock_step_hidden,
      {run.name, by, from, to}};
}

/// A drive with its clock.
struct Clocked {
  ClockFit clock;
  std::shared_ptr<const Trajectory> retimed = {};
  std::vector<Remark> mended = {};
  std::optional<Remark> useless = {};  // why the drive cannot be used
};

/// Finds the clock of a drive, and takes steps of either stream's clock out of it.
Clocked clocked(const Trajectory& run, const WheelFactors& loaded, const std::optional<ClockFit>& before) {
  constexpr std::size_t kMostSteps = 8;
  constexpr double kAsGood = 0.002;  // of the correlation
  Clocked found{clock_of(run, loaded, before)};
  if (!in_common(found.clock) || found.clock.rival_offset_s) return found;  // it is not known where to look
  const Trajectory* now = &run;
  while (true) {
    const auto step = find_clock_step(*now, found.clock, loaded.b_m);
    auto leap = step ? find_leap(*now, *step, found.clock) : std::nullopt;
    const bool by_motion = leap.has_value();
    if (!leap) leap = find_leap_without_way(*now, loaded.b_m);
    std::shared_ptr<Trajectory> retimed;
    ClockFit clock;
    if (leap && found.mended.size() < kMostSteps) {
      retimed = std::make_shared<Trajectory>(*now);
      take_back(*retimed, *leap);
      clock = clock_of(*retimed, loaded, before);
    }
    if (!retimed || (!by_motion && clock.correlation < found.clock.correlation - kAsGood)) {
      if (step && step->sure) found.useless = why_step_hidden(*now, *step);
      return found;
    }
    found.mended.push_back(why_retimed(*now, *leap));
    found.retimed = std::move(retimed);
    now = found.retimed.get();
    found.clock = clock;
  }
}

Remark why_unsettled(const Trajectory& run, const ClockFit& clock) {
  return {fmt::format("{} repeats itself, so that its clocks may be {:.1f} s apart as well as {:.1f} s",
                      run.name, clock.offset_s, *clock.rival_offset_s),
          PreparationProblem::clock_unsettled,
          {run.name}};
}

void require_in_common(const Trajectory& run, const ClockFit& clock) {
  if (!in_common(clock))
    throw Error(
        run.name +
            ": the motions of wheels and ground truth have nothing in common at any offset of their clocks",
        PreparationProblem::nothing_in_common, {run.name});
}

}  // namespace

PreparedRuns prepare(std::span<const Trajectory> runs, const WheelFactors& loaded, bool clock_known,
                     Density density) {
  if (runs.empty()) throw Error("there are no runs to calibrate from", PreparationProblem::no_runs);
  PreparedRuns prepared;
  std::optional<ClockFit> before;
  for (const Trajectory& original : runs) {
    require_samples(original, clock_known);
    const std::shared_ptr<const Trajectory> turned = turned_by_slips(original, loaded);
    const Trajectory& recorded = turned ? *turned : original;
    Clocked found;
    if (!clock_known) {
      found = clocked(recorded, loaded, before);
      if (is_blind_spin(recorded, found.clock, loaded.b_m))
        found.useless = why_blind(recorded);
      else if (found.clock.rival_offset_s && found.clock.correlation >= kLeastCorrelation)
        found.useless = why_unsettled(recorded, found.clock);
      if (found.useless) {
        prepared.left_out.push_back(*found.useless);
        continue;
      }
      require_in_common(recorded, found.clock);
      before = found.clock;
      prepared.mended.insert(prepared.mended.end(), found.mended.begin(), found.mended.end());
    }
    if (!found.retimed) found.retimed = turned;
    const Trajectory& run = found.retimed ? *found.retimed : recorded;
    const ClockFit& clock = found.clock;
    PreparedRun ready = cropped(run, clock, loaded.b_m, density);
    ready.mended = found.retimed;
    say_bridged(run, ready.gaps, prepared.mended);
    const std::vector<WheelState> wheels = wheels_at_truth(ready, clock);
    classify_motion(ready, wheels, clock, loaded);
    ready.path_m = way_of_wheels(wheels);
    ready.knots_m = way_of_knots(ready, loaded.b_m);
    require_motion(ready);
    if (!run.ends_only) require_handedness(ready, clock, loaded);
    prepared.runs.push_back(std::move(ready));
    prepared.clocks.push_back(clock);
  }
  if (prepared.runs.empty()) throw Error(prepared.left_out.front());
  require_handedness_of_ends(prepared.runs, loaded);
  find_sessions(prepared, loaded);
  return prepared;
}

}  // namespace astro::calibration
