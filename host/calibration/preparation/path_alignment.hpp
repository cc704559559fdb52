#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "host/calibration/motion/arc.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/motion/wheel_path.hpp"
#include "host/calibration/preparation/preparation.hpp"
#include "host/calibration/preparation/relative_pose.hpp"

/// Dead-reckoned paths, and their rigid alignment with truth.
namespace astro::calibration {

/// Walks along the wheels' path, forwards in time on the robot's clock.
class WheelWalk {
 public:
  /// The samples must outlive this.
  WheelWalk(std::span<const WheelSample> wheels, double begin_s)
      : path_(wheels), at_s_(begin_s), at_(path_.at(begin_s)) {}

  /// Advances to `to_s` and calls `visit` with the wheels' travel in steps that are short enough to be arcs of constant twist.
  template <class Visit>
  void go(double to_s, Visit visit) {
    const double from_s = at_s_;
    const int count = std::max(1, static_cast<int>(std::ceil((to_s - from_s) / kLongestStep_s)));
    for (int i = 1; i <= count; ++i) {
      const WheelState now = path_.at(i == count ? to_s : from_s + (to_s - from_s) * i / count);
      visit(WheelStep{now.left_m - at_.left_m, now.right_m - at_.right_m});
      at_ = now;
    }
    at_s_ = to_s;
  }

 private:
  WheelPath path_;
  double at_s_;
  WheelState at_;
};

/// Dead reckoning by `factors` at the times of the prepared truth, from pose (0, 0, 0) at the first.
std::vector<BodySample> dead_reckoned(const PreparedRun& run, const ClockFit& clock,
                                      const WheelFactors& factors);

/// The rigid motion, with or without reflection, that brings one path closest to another.
struct RigidFit {
  Pose2 motion;  // to = motion * from, y of `from` negated if mirrored
  double rms_m = 0;
};
RigidFit fit_rigid(std::span<const BodySample> from, std::span<const BodySample> to, bool mirrored);

}  // namespace astro::calibration
