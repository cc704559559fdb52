#pragma once

#include <optional>
#include <span>

#include "host/calibration/end_poses/end_scatter.hpp"

/// The common scale of both wheels from straight lines whose length somebody measured: what squares do not observe.
namespace astro::calibration {

/// The measured end of a line, in its start frame.
struct LineEnd {
  double x_m = 0, y_m = 0;
  double driven_m = 0;      // by odometry
  double loaded_scale = 1;  // (c_R + c_L) / 2 of that odometry

  /// The scale that this line gives: the measured length, along the slight arc that ends there, over that of odometry.
  double scale() const;
};

struct LineScale {
  double scale = 1, se = 0;  // absolute: (c_R + c_L) / 2 to load
  int lines = 0;
};

/// The most likely scale, robust as fit_ends is: of three lines one may be wrong. Nothing without a line. The standard error
/// contains slip, reading and how much the lines differ; it is known for a single line, too.
///
/// Throws astro::Error if the scale is outside 0.5 to 2, which means another unit.
/// Precondition  the lines were driven forwards: driven_m > 0.
std::optional<LineScale> scale_of_lines(std::span<const LineEnd> lines, const EndNoise& noise = {});

/// Whether a line ends behind its start, or is more than 3 % longer or shorter than odometry with the scale `expected` says. Wheels are rarely so far
/// from their nominal diameter, so that it looks mistyped.
bool is_odd(const LineEnd& line, double expected);

}  // namespace astro::calibration
