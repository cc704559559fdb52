#include "host/calibration/preparation/wheel_way.hpp"

#include <algorithm>
#include <cmath>

namespace astro::calibration {
namespace {

/// A standing wheel may flicker between two counts for minutes; that does not count as path.
constexpr double kFlicker_m = 2e-3;

/// The path after which a robot that drives on has unwound its tyres and castor.
constexpr double kUnwinding_m = 0.01;
/// The path of the wheels, in wheelbases, over which a spin can wind up.
constexpr double kWindingUp = 0.5;

bool turns_or_stands(Motion motion) { return motion == Motion::spin || motion == Motion::rest; }

}  // namespace

std::vector<WheelState> wheels_at_truth(const PreparedRun& run, const ClockFit& clock) {
  const WheelPath path(run.source->wheels);
  std::vector<WheelState> wheels;
  wheels.reserve(run.truth.size());
  for (const BodySample& sample : run.truth)
    wheels.push_back(path.at(clock.robot_time_s(sample.time_s, run.clock_middle_s)));
  return wheels;
}

std::vector<double> way_of_wheels(std::span<const WheelState> wheels) {
  std::vector<double> way_m;
  way_m.reserve(wheels.size());
  WheelState counted;
  double sum_m = 0;
  for (const WheelState& now : wheels) {
    if (way_m.empty()) counted = now;
    const double moved_m =
        (std::abs(now.left_m - counted.left_m) + std::abs(now.right_m - counted.right_m)) / 2;
    if (moved_m > kFlicker_m) {
      sum_m += moved_m;
      counted = now;
    }
    way_m.push_back(sum_m);
  }
  return way_m;
}

std::vector<double> way_of_knots(const PreparedRun& run, double wheelbase_m) {
  std::vector<double> knots_m = run.path_m;
  const std::size_t count = run.path_m.size();
  for (std::size_t from = 0; from < count;) {
    std::size_t to = from;
    while (to < count && turns_or_stands(run.motion[to])) ++to;
    if (to == from) {
      ++from;
      continue;
    }
    // motion[i] is the motion before sample i.
    const double begin_m = run.path_m[from > 0 ? from - 1 : 0], end_m = run.path_m[to - 1];
    const double held_m = std::min((end_m - begin_m) / 2, kWindingUp * wheelbase_m);
    for (std::size_t i = from; i < to; ++i) {
      if (run.path_m[i] < begin_m + held_m) knots_m[i] = begin_m;
      if (run.path_m[i] > end_m - held_m) knots_m[i] = end_m - held_m;
    }
    for (; to < count && run.path_m[to] < end_m + kUnwinding_m && !turns_or_stands(run.motion[to]); ++to)
      knots_m[to] = end_m - held_m;
    from = to;
  }
  return knots_m;
}

}  // namespace astro::calibration
