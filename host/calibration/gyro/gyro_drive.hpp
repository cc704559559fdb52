#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// A drive of a robot with a gyro, and what both say of its turns.
namespace astro::calibration {

/// What a gyro says about the robot's vertical axis, counter-clockwise positive, its bias included: the mean rate since the sample
/// before. Robot's clock.
struct YawRate {
  double time_s = 0, rate_radps = 0;
};

struct GyroDrive {
  std::string name;
  std::vector<WheelSample> wheels;  // at least two
  std::vector<YawRate> rates;       // in order of time
  std::vector<BodySample> truth;    // on the robot's clock; empty where nothing measured its heading
  double count_m = 0;               // travel of a nominal wheel in a count
};

/// How far the gyro has turned since its first sample, linear between samples.
class GyroPath {
 public:
  explicit GyroPath(std::span<const YawRate> rates);

  struct Place {
    double turn_rad = 0;
    /// Counts the gaps before it. What the gyro turned in a gap of more than a tenth of a second, and five usual periods, is unknown.
    int piece = 0;
    bool known = false;  // not before the first sample, after the last one or in a gap
  };
  Place at(double time_s) const;

 private:
  std::vector<double> times_s_, turns_rad_;
  std::vector<int> pieces_;
  mutable std::size_t last_ = 0;
};

/// Heading and ways by the wheels, at a sample of them.
struct WheelTurn {
  double time_s = 0;
  Pose2 pose;               // by dead reckoning from the first sample on; the heading is not wrapped
  double rate_radps = 0;    // over 40 ms about the sample at least
  double change_radps = 0;  // of the rate, from 0.15 s before to 0.15 s after
  double way_m = 0;         // of the middle, signed
  double path_m = 0;        // that both wheels rolled, in either direction
};
std::vector<WheelTurn> wheel_turns(std::span<const WheelSample> wheels, const WheelFactors& factors);

}  // namespace astro::calibration
