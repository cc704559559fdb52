#include "host/import/drives/wheel_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "host/base/error.hpp"
#include "host/import/drives/robot_geometry.hpp"

namespace astro::importing {
namespace {

constexpr double kMoved_m = 0.2, kTurned_rad = 0.7;

/// What the wheels did in a drive, in counts.
struct WheelWays {
  std::int64_t left = 0, right = 0;  // steps added up
  std::int64_t as_steps = 0;         // the same of the samples themselves, the mean of both wheels
  bool same = true;                  // in each step
};

WheelWays ways_of(const recording::Run& run) {
  WheelWays ways;
  for (std::size_t i = 1; i < run.odometry.size(); ++i) {
    const recording::OdometrySample &before = run.odometry[i - 1], &now = run.odometry[i];
    const std::int64_t left = std::int64_t{now.left_counts} - before.left_counts,
                       right = std::int64_t{now.right_counts} - before.right_counts;
    ways.left += std::abs(left);
    ways.right += std::abs(right);
    ways.as_steps += (std::abs(std::int64_t{now.left_counts}) + std::abs(std::int64_t{now.right_counts})) / 2;
    ways.same = ways.same && left == right;
  }
  return ways;
}

/// How far the ground truth turned: from its rightmost to its leftmost heading, or 0 without headings.
double turned_rad(const recording::Run& run) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const recording::TruthSample& sample : run.truth) {
    if (!sample.valid || std::isnan(sample.theta_rad)) continue;
    least = std::min(least, sample.theta_rad);
    most = std::max(most, sample.theta_rad);
  }
  return std::max(0.0, most - least);
}

/// Whether the ground truth has a stretch as long as the wheels' recording, and in which it goes as far as they do, without a
/// turn: then the wheels may have been recorded there, and the turns before or after. The clocks are not known yet.
bool may_go_straight(const recording::Run& run, double count_m) {
  constexpr int kStretches = 20;  // that begin within one length of the wheels' recording
  constexpr double kPart = 0.5;
  const recording::OdometrySample& start = run.odometry.front();
  std::int64_t reach = 0;
  for (const recording::OdometrySample& at : run.odometry)
    reach = std::max(reach, std::abs(std::int64_t{at.left_counts} - start.left_counts));
  const std::int64_t span_us = run.odometry.back().time_us - start.time_us;
  const double wanted_m = kPart * count_m * static_cast<double>(reach);
  std::int64_t next_us = run.truth.front().time_us;
  for (std::size_t from = 0; from < run.truth.size(); ++from) {
    const recording::TruthSample& first = run.truth[from];
    if (!first.valid || first.time_us < next_us) continue;
    if (first.time_us + span_us > run.truth.back().time_us && from > 0) return false;
    next_us = first.time_us + span_us / kStretches;
    double least = HUGE_VAL, most = -HUGE_VAL, reach_m = 0;
    for (std::size_t i = from; i < run.truth.size() && run.truth[i].time_us <= first.time_us + span_us; ++i) {
      const recording::TruthSample& at = run.truth[i];
      if (!at.valid || std::isnan(at.theta_rad)) continue;
      least = std::min(least, at.theta_rad);
      most = std::max(most, at.theta_rad);
      reach_m = std::max(reach_m, std::hypot(at.x_m - first.x_m, at.y_m - first.y_m));
    }
    if (reach_m > wanted_m && most - least < kTurned_rad) return true;
  }
  return false;
}

/// How long a drive lasts: from where it first leaves the place of its start to where it last comes to that of its end. 0 if it
/// goes nowhere.
template <class Sample>
double moving_s(const std::vector<Sample>& samples, const auto& is_used) {
  constexpr double kLeft_m = 0.1;
  const auto far = [](const Sample& a, const Sample& b) {
    return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) > kLeft_m;
  };
  const Sample *begin = nullptr, *end = nullptr, *first = nullptr, *last = nullptr;
  for (const Sample& sample : samples) {
    if (!is_used(sample)) continue;
    if (begin == nullptr) begin = &sample;
    if (first == nullptr && far(sample, *begin)) first = &sample;
    end = &sample;
  }
  for (const Sample& sample : samples)
    if (is_used(sample) && far(sample, *end)) last = &sample;
  if (first == nullptr || last == nullptr) return 0;
  return std::max(0.0, 1e-6 * static_cast<double>(last->time_us - first->time_us));
}

/// The way forward minus that backward by the wheels, over both: -1 for a robot that only drove backward.
double forward_share(const recording::Run& run) {
  double sum = 0, all = 0;
  for (std::size_t i = 1; i < run.odometry.size(); ++i) {
    const recording::OdometrySample &before = run.odometry[i - 1], &now = run.odometry[i];
    const double left = double(now.left_counts) - double(before.left_counts),
                 right = double(now.right_counts) - double(before.right_counts);
    sum += left + right;
    all += std::abs(left + right);
  }
  return all > 0 ? sum / all : 0;
}

}  // namespace

void require_times_alike(const recording::Run& run, const truth::FloorFindings& floor,
                         const AssumedTimeUnit& wheels, const AssumedTimeUnit& truth) {
  constexpr double kSeveral = 3, kMany = 20, kFurther = 1.5;
  const AssumedTimeUnit& assumed = wheels.unit.empty() ? truth : wheels;
  if (assumed.unit.empty()) return;
  const double by_wheels = moving_s(run.odometry, [](const auto&) { return true; }),
               by_truth = moving_s(run.truth, [](const recording::TruthSample&at) { return at.valid; });
  if (!(by_wheels > 0 && by_truth > 0)) return;
  // A tracker may go on for many drives of which the wheels' file has one. Then it sees a longer way, too.
  const double most = floor.path_m > kFurther * floor.wheels_path_m ? kMany : kSeveral;
  if (by_wheels < kSeveral * by_truth && by_truth < most * by_wheels) return;
  const bool of_wheels = &assumed == &wheels;
  const std::string own = fmt::format("{:.3g}", of_wheels ? by_wheels : by_truth),
                    other = fmt::format("{:.3g}", of_wheels ? by_truth : by_wheels);
  throw Error(fmt::format("the times in '{}' have no unit, and with {} the drive lasts {} s, but {} s by the "
                          "other file",
                          assumed.file, assumed.unit, own, other),
              ImportProblem::time_unit_doubtful, {assumed.file, assumed.unit, own, other});
}

void require_turning_wheels(const std::string& name, const recording::Run& run,
                            const truth::FloorFindings& floor) {
  const WheelWays ways = ways_of(run);
  const double turned = turned_rad(run);
  if (floor.path_m < kMoved_m && turned < kTurned_rad) return;
  if (ways.left == 0 && ways.right == 0)
    throw Error(
        "the wheels never turn while the ground truth moves: check the columns or joints of the wheels",
        ImportProblem::wheels_stand, {name});
  if (ways.left == 0 || ways.right == 0) {
    const std::string side = ways.left == 0 ? "left" : "right";
    throw Error("the " + side + " wheel never turns: check its encoder, and which column or joint it is",
                ImportProblem::wheel_stands, {name, side});
  }
  const double count_m = floor.wheels_path_m / (static_cast<double>(ways.left + ways.right) / 2);
  if (ways.same && turned > kTurned_rad && !may_go_straight(run, count_m))
    throw Error("both wheels do exactly the same while the robot turns: one of them stands in both places",
                ImportProblem::wheels_equal, {name});
  const double as_steps_m = count_m * static_cast<double>(ways.as_steps);
  constexpr double kHardly = 0.2, kSame = 2.5;
  if (floor.path_m > kMoved_m && floor.wheels_path_m < kHardly * floor.path_m &&
      as_steps_m > floor.path_m / kSame && as_steps_m < floor.path_m * kSame)
    throw Error(
        "the wheels go nowhere, but as far as the ground truth if each sample is the travel since the one "
        "before",
        ImportProblem::per_interval_likely, {name});
}

bool drove_backward(const recording::Run& run) {
  constexpr double kForTheMostPart = -0.3;  // spins and flickering counts go either way
  return forward_share(run) < kForTheMostPart;
}

}  // namespace astro::importing
