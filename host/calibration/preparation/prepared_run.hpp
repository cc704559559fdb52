#pragma once

#include <array>
#include <memory>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"

namespace astro::calibration {

struct MotionExtent {
  double distance_m = 0, rotation_rad = 0;
};

/// A stretch without odometry in which the robot moved: samples were lost, or are so seldom that it turned between two. How far
/// its wheels turned is known from the counts before and after, and so is the heading after it, but not the way between. No
/// truth sample within it is used. A slip is one, too, after which the heading is not known as well.
struct WheelGap {
  double begin_s = 0, end_s = 0;  // on the robot's clock
  double unknown_m2 = 0;          // variance of each coordinate of the position after it
  double unknown_rad2 = 0;        // of the heading
};

/// A drive prepared for the filter: the truth samples that the odometry covers, each with the robot's motion.
struct PreparedRun {
  const Trajectory* source = nullptr;
  std::shared_ptr<const Trajectory> mended =
      {};  // the source if a clock of the drive was set anew or its wheels slipped, otherwise none
  std::vector<BodySample> truth;
  std::vector<Motion> motion;   // between the previous sample and this one
  std::vector<double> path_m;   // path length of the wheels up to each sample, the mean of both
  std::vector<WheelGap> gaps;   // in the order of their times
  std::vector<double> knots_m;  // path length by which samples are chosen (wheel_way.hpp)
  int session = 0;              // runs of one session share lever arm and skew (sessions.hpp)
  double clock_middle_s = 0;    // tracker's time at which the skew has no effect
  bool has_headings = true;     // of all samples; if false, no heading is used
  double distance_m = 0, rotation_rad = 0;
  std::array<MotionExtent, 4> extent{};  // by Motion
};

}  // namespace astro::calibration
