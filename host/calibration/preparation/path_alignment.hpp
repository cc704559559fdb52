#pragma once

#include <span>
#include <vector>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/motion/wheel_path.hpp"
#include "host/calibration/preparation/preparation.hpp"
#include "host/calibration/preparation/relative_pose.hpp"

/// Dead-reckoned paths, and their rigid alignment with truth.
namespace astro::calibration {

/// Travel of the wheels from one robot's time to another, in steps short enough to be arcs of constant twist.
std::vector<WheelStep> wheel_steps(const WheelPath& path, double from_s, double to_s);

/// Dead reckoning by `factors` at the times of the prepared truth, from pose (0, 0, 0) at the first.
std::vector<BodySample> dead_reckoned(const PreparedRun& run, const ClockFit& clock,
                                      const WheelFactors& factors);

/// The rigid motion, with or without reflection, that brings one path closest to another.
struct RigidFit {
  double rotation_rad = 0, x_m = 0,
         y_m = 0;  // to = R(rotation) * from + (x, y), y of `from` negated if mirrored
  double rms_m = 0;
};
RigidFit fit_rigid(std::span<const BodySample> from, std::span<const BodySample> to, bool mirrored);

}  // namespace astro::calibration
