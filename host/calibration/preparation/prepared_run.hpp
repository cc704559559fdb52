#pragma once

#include <array>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"

namespace astro::calibration {

struct MotionExtent {
  double distance_m = 0, rotation_rad = 0;
};

/// A drive made ready: truth that wheels cover, and what was going on at each of its samples.
struct PreparedRun {
  const Trajectory* source = nullptr;
  std::vector<BodySample> truth;
  std::vector<Motion> motion;  // between the previous sample and this one
  double clock_middle_s = 0;   // tracker's time about which the skew turns
  bool has_headings = true;    // of all samples; else none is used
  double distance_m = 0, rotation_rad = 0;
  std::array<MotionExtent, 4> extent{};  // by Motion
};

}  // namespace astro::calibration
