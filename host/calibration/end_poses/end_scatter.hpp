#pragma once

#include <Eigen/Core>

#include "host/base/text/sense.hpp"

namespace astro::calibration {

/// The noise that makes the measured ends of equal squares differ.
///
/// slip_m      variance of a wheel's travel per metre. The default gives the scatter of the thesis's tables: 55 mm and
///             28 mrad at the end of a square of 3 m.
/// reading_m   standard deviation of a position that a person reads off a tape measure
/// reading_rad of a heading from two marks on the chassis, 0.3 m apart, each read to 1.5 mm
struct EndNoise {
  double slip_m = 2.645e-6;
  double reading_m = 0.002, reading_rad = 0.007;
};

/// Covariance of x, y and theta at the end of a square. A slip turns the rest of the path about the place where it happens, so
/// the three errors are correlated: the heading alone explains most of the position.
///
/// Precondition  side_m and b_m are positive.
Eigen::Matrix3d end_covariance(double side_m, Sense sense, double b_m, const EndNoise& noise = {});

}  // namespace astro::calibration
