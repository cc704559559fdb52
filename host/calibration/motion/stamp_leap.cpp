#include "host/calibration/motion/stamp_leap.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "host/base/order_statistics.hpp"
#include "host/base/pose2.hpp"
#include "host/calibration/motion/tracker_noise.hpp"

namespace astro::calibration {
namespace {

/// What moved between two samples: both wheels, or the body ahead and about itself.
Eigen::Array2d way_m(const WheelSample& a, const WheelSample& b, double /*wheelbase_m*/) {
  return {b.left_m - a.left_m, b.right_m - a.right_m};
}

Eigen::Array2d way_m(const BodySample& a, const BodySample& b, double wheelbase_m) {
  const double turned_rad = wrapped_rad(b.theta_rad - a.theta_rad);
  return {std::hypot(b.x_m - a.x_m, b.y_m - a.y_m),
          std::isfinite(turned_rad) ? wheelbase_m / 2 * turned_rad : 0};
}

double mean_of_both(const Eigen::Array2d& way) { return way.abs().sum() / 2; }

/// Mean speed over some tenths of a second that end at, or begin with, a sample.
template <class Samples>
Eigen::Array2d speed_mps(const Samples& samples, std::size_t from, int step, double wheelbase_m) {
  constexpr double kOver_s = 0.3;
  std::size_t to = from;
  while (std::abs(samples[to].time_s - samples[from].time_s) < kOver_s) {
    if (step < 0 ? to == 0 : to + 1 == samples.size()) return {0, 0};
    to = step < 0 ? to - 1 : to + 1;
  }
  return way_m(samples[std::min(from, to)], samples[std::max(from, to)], wheelbase_m) /
         std::abs(samples[to].time_s - samples[from].time_s);
}

/// Whether the samples after a leap come in half the time that as many take otherwise: those that a link held back.
bool catches_up(const auto& samples, std::size_t after, double late_s, double usual_s) {
  const auto held_back = static_cast<std::size_t>(std::max(1.0, late_s / usual_s));
  const std::size_t last = std::min(after + held_back, samples.size() - 1);
  return samples[last].time_s - samples[after].time_s < 0.5 * usual_s * static_cast<double>(last - after);
}

}  // namespace

std::optional<StampLeap> find_leap(const Trajectory& run, const ClockStep& step, const ClockFit& clock) {
  // The motion shows a step to a bin of its profile, and no better than to a part of a slow log's period.
  const double alike_s = 0.05 + 0.3 * std::max(median_period_s(run.wheels), median_period_s(run.truth));
  std::optional<StampLeap> found;
  double off_s = alike_s;
  const auto look = [&](const auto& samples, StampedStream stream, double sign, double clock_s) {
    const double usual_s = median_period_s(samples), reach_s = std::abs(step.by_s) + 0.5;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const double from_s = samples[i - 1].time_s - clock_s, to_s = samples[i].time_s - clock_s;
      if (to_s < step.begin_s - reach_s || from_s > step.end_s + reach_s) continue;
      const double late_s = to_s - from_s - usual_s;
      if (late_s < usual_s / 2 || std::abs(sign * late_s - step.by_s) >= off_s) continue;
      off_s = std::abs(sign * late_s - step.by_s);
      found = StampLeap{stream, i, late_s};
    }
  };
  look(run.wheels, StampedStream::odometry, 1, clock.offset_s);
  look(run.truth, StampedStream::ground_truth, -1, 0);
  return found;
}

std::optional<StampLeap> find_leap_without_way(const Trajectory& run, double wheelbase_m) {
  constexpr double kShortestLeap_s = 0.06;
  constexpr double kDiffer = 0.3, kHalf = 0.5, kFromNoise = 5, kLeastWay_m = 0.01, kSlowest_mps = 0.02;
  SecondDifferences differences;
  differences.add(run.truth);
  const double noise_m =
      std::hypot(differences.sigma_xy_m(), wheelbase_m / 2 * differences.sigma_theta_rad());
  std::optional<StampLeap> found;
  const auto look = [&](const auto& samples, StampedStream stream, double least_m) {
    const double usual_s = median_period_s(samples);
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const double late_s = samples[i].time_s - samples[i - 1].time_s - usual_s;
      if (late_s < std::max({kShortestLeap_s, 1.5 * usual_s, found ? found->by_s : 0})) continue;
      if (catches_up(samples, i, late_s, usual_s)) continue;
      const Eigen::Array2d before = speed_mps(samples, i - 1, -1, wheelbase_m),
                           after = speed_mps(samples, i, 1, wheelbase_m);
      const double speed = mean_of_both(before + after) / 2;
      if (speed < kSlowest_mps || mean_of_both(after - before) > kDiffer * speed) continue;
      const double due_m = late_s * speed;
      if (due_m > least_m &&
          mean_of_both(way_m(samples[i - 1], samples[i], wheelbase_m)) < usual_s * speed + kHalf * due_m)
        found = StampLeap{stream, i, late_s};
    }
  };
  look(run.wheels, StampedStream::odometry, kLeastWay_m);
  look(run.truth, StampedStream::ground_truth, std::max(kLeastWay_m, kFromNoise * noise_m));
  return found;
}

void take_back(Trajectory& run, const StampLeap& leap) {
  const auto shift = [&](auto& samples) {
    for (std::size_t i = leap.after; i < samples.size(); ++i) samples[i].time_s -= leap.by_s;
  };
  if (leap.stream == StampedStream::ground_truth) return shift(run.truth);
  const double first_s = run.wheels.at(leap.after).time_s;
  for (Slip& slip : run.slips) {
    if (slip.begin_s >= first_s) slip.begin_s -= leap.by_s;
    if (slip.end_s >= first_s) slip.end_s -= leap.by_s;
  }
  shift(run.wheels);
}

}  // namespace astro::calibration
