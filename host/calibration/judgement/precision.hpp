#pragma once

/// How precisely a drive determines the wheel factors, and how long it has to be: design rules for use before
/// anything is driven.
///
/// The noise is wheel slip alone, white along the path: each wheel's travel has the variance K * |distance|.
/// Against a ground truth that follows the whole drive the best unbiased estimator then reaches
///
///   sd(E_d) = sqrt(2 K / D),   sd(S) = sqrt(K / (2 D)),   sd(b) / b = sqrt(K / (b Theta))
///
/// with D the distance driven and Theta the sum of |rotation| of spins; arcs wider than b / 2 slip along
/// their own length as well and determine less. The b of its rule is b / S; the error of S adds to it. The
/// rules are within 4 % of the Cramer-Rao bound of ten 3 m squares. End poses alone do worse: their E_d and b
/// are correlated, and a closed path does not observe S.
///
/// Errors  astro::Error for a length, K, rotation or count that is not positive and finite.
namespace astro::calibration {

/// What a drive, or several together, consist of.
struct DriveExtent {
  double distance_m = 0;    // of the robot's centre
  double rotation_rad = 0;  // sum of the magnitudes
};

/// Standard deviations, all relative: E_d and S are ratios near 1, b is divided by b.
struct Precision {
  double E_d = 0, scale = 0, b = 0;
};

/// K_m is the slip variance per metre, m^2 / m; 2.645e-6 m gives the scatter of the thesis's robot.
Precision reachable_precision(const DriveExtent& extent, double K_m, double b_m);

}  // namespace astro::calibration
