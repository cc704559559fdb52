#pragma once

#include <optional>
#include <span>

#include "host/calibration/end_poses/end_scatter.hpp"

/// The common scale of both wheels from straight lines of measured length. Squares do not observe it.
namespace astro::calibration {

/// The measured end of a line, in its start frame.
struct LineEnd {
  double x_m = 0, y_m = 0;
  double driven_m = 0;      // by odometry
  double loaded_scale = 1;  // (c_R + c_L) / 2 of that odometry

  /// The scale from this line: loaded_scale times the length of the slight arc that ends at (x, y), over driven_m.
  double scale() const;
};

struct LineScale {
  double scale = 1, se = 0;  // absolute: (c_R + c_L) / 2 to load
  int lines = 0;
};

/// The most likely scale, with the robust weights of fit_ends, so that one of three lines may be wrong. Returns nothing without
/// a line. The standard error contains slip, the reading error and the scatter of the lines; it is defined for a single line,
/// too.
///
/// Throws astro::Error if the scale is outside 0.5 to 2, because the lengths then have another unit.
/// Precondition  the lines were driven forwards: driven_m > 0.
std::optional<LineScale> scale_of_lines(std::span<const LineEnd> lines, const EndNoise& noise = {});

/// Whether a line ends behind its start, or its length differs by more than 3 % from what odometry with the scale `expected`
/// says. Wheels rarely differ so much from their nominal diameter, so the length was probably mistyped.
bool is_odd(const LineEnd& line, double expected);

}  // namespace astro::calibration
