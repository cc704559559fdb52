#include "host/lidar/stretch.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibration/motion/arc.hpp"
#include "host/calibration/motion/wheel_path.hpp"

namespace astro::lidar {
namespace {

using calibration::WheelFactors;

/// The body's velocity times `over_s`, with a constant rate of the wheels.
Twist2 moved(const WheelStep& rate, double over_s, const WheelFactors& factors) {
  const double right_m = factors.c_r * rate.right_m * over_s, left_m = factors.c_l * rate.left_m * over_s;
  return {(right_m + left_m) / 2, 0,
          (right_m - left_m) / calibration::effective_wheelbase_m(right_m, left_m, factors)};
}

/// Puts short steps together, because an hour at 1 kHz has millions of them.
class Joined {
 public:
  Joined(const WheelFactors& loaded, std::vector<WheelStep>& steps) : loaded_(loaded), steps_(steps) {}

  void add(double left_m, double right_m) {
    constexpr double kLongest_m = 0.05, kMostTurn_rad = 0.005;
    sum_.left_m += left_m;
    sum_.right_m += right_m;
    const Twist2 all = moved(sum_, 1, loaded_);
    if (std::abs(all.x_m) > kLongest_m || std::abs(all.theta_rad) > kMostTurn_rad) finish();
  }
  void finish() {
    if (sum_.left_m != 0 || sum_.right_m != 0) steps_.push_back(sum_);
    sum_ = {};
  }

 private:
  const WheelFactors& loaded_;
  std::vector<WheelStep>& steps_;
  WheelStep sum_;
};

}  // namespace

Unknowns nothing_wrong(const WheelFactors& loaded) {
  Unknowns unknowns = Unknowns::Zero();
  unknowns(kScale) = unknowns(kTurn) = 1;
  unknowns(kArcs) = loaded.e;
  return unknowns;
}

WheelFactors factors_of(const Unknowns& unknowns, const WheelFactors& loaded) {
  WheelFactors factors = loaded;
  factors.b_m = loaded.b_m * unknowns(kScale) / unknowns(kTurn);
  const double half = unknowns(kBend) * factors.b_m / 2;
  factors.c_r = loaded.c_r * (unknowns(kScale) + half);
  factors.c_l = loaded.c_l * (unknowns(kScale) - half);
  factors.e = unknowns(kArcs);
  return factors;
}

calibration::LeverArm lever_of(const Unknowns& unknowns) {
  return {unknowns(kLeverX), unknowns(kLeverY), unknowns(kLeverYaw)};
}

Pose2 predicted(const Stretch& stretch, const Unknowns& unknowns, const WheelFactors& loaded) {
  const WheelFactors factors = factors_of(unknowns, loaded);
  Pose2 robot;
  for (const WheelStep& step : stretch.steps) calibration::advance(robot, step.right_m, step.left_m, factors);
  if (const double later_s = unknowns(kLate) - stretch.late_s; later_s != 0)
    robot = moved(stretch.rate_before, later_s, factors).exp() * robot *
            moved(stretch.rate_after, -later_s, factors).exp();
  const Pose2 lever = lever_of(unknowns);
  return lever.inverse() * robot * lever;
}

Stretch cut_stretch(std::span<const calibration::WheelSample> wheels, const WheelFactors& loaded,
                    double from_s, double to_s, double late_s) {
  Stretch stretch;
  stretch.from_s = from_s;
  stretch.to_s = to_s;
  stretch.late_s = late_s;
  const calibration::WheelPath path(wheels);
  const double first_s = from_s - late_s, last_s = to_s - late_s;
  const calibration::WheelState start = path.at(first_s), end = path.at(last_s);
  stretch.rate_before = {start.left_mps, start.right_mps};
  stretch.rate_after = {end.left_mps, end.right_mps};
  Joined steps(loaded, stretch.steps);
  double left_m = start.left_m, right_m = start.right_m;
  auto sample = std::upper_bound(
      wheels.begin(), wheels.end(), first_s,
      [](double time_s, const calibration::WheelSample& one) { return time_s < one.time_s; });
  for (; sample != wheels.end() && sample->time_s < last_s; ++sample) {
    steps.add(sample->left_m - left_m, sample->right_m - right_m);
    left_m = sample->left_m;
    right_m = sample->right_m;
  }
  steps.add(end.left_m - left_m, end.right_m - right_m);
  steps.finish();
  return stretch;
}

}  // namespace astro::lidar
