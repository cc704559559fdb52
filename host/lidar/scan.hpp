#pragma once

#include <cstdint>
#include <vector>

/// One turn of a laser scanner, or the part of a turn that it sees.
namespace astro::lidar {

/// Frames  angles in the scanner's frame (x forward where the scanner says so, y left), counter-clockwise. The scanner's place
///         on the robot is not part of a scan.
/// Units   metres, radians, seconds; the times of the first beam are whole nanoseconds of whatever clock stamped the scan,
///         because an epoch time in seconds does not fit into a double.
struct Scan {
  std::int64_t time_ns = 0;    // of the first beam
  double first_angle_rad = 0;  // of the first beam
  double angle_step_rad = 0;   // to the next beam; negative: the beams run clockwise
  double beam_interval_s = 0;  // between two beams; 0: all beams are of one moment, or nobody knows
  double range_min_m = 0;      // readings outside of these limits say nothing
  double range_max_m = 0;
  std::vector<float> ranges_m;  // NaN or infinite: nothing was seen
};

/// Standard error of the common scale of a scanner's ranges, which no drive shows, where nobody has measured it: makers state one
/// to two per cent of the range.
inline constexpr double kRangeScaleSigma = 0.01;

}  // namespace astro::lidar
