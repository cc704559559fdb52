#pragma once

#include "host/calibration/end_poses/end_pose.hpp"

/// The closed formulas from mean end poses to E_d and E_b. Runs, scatter and files are handled elsewhere.
///
/// alpha: turn error of one spin (the odometry's quarter turn minus the true one); beta: how far one leg
/// turns to the left. Both in radians. E_d = D_R / D_L, E_b = b_actual / b_odometry.
///
/// Precondition: side_m and b_m are positive and finite.
/// Errors  none. An implausible mean gives an implausible ratio.
namespace astro::calibration {

/// Mean end poses (centres of gravity) of the two directions.
struct MeanErrors {
  EndPose cw, ccw;
};

/// From which coordinate the angles are taken: alpha and beta from x, both from y, alpha from x and beta from
/// y as in the thesis, or the mean of the x and the y angles.
enum class AngleSource { x, y, thesis, average };

/// Of the extended method: as printed by Jung & Chung and the thesis, or exact for c_R + c_L constant.
enum class Formula { exact, published };

struct SquareAngles {
  double alpha_rad = 0, beta_rad = 0;
};

struct Ratios {
  double alpha_rad = 0, beta_rad = 0;
  double alpha_Ed_rad = 0;     // the term that Formula::published adds to alpha; 0 elsewhere
  double curvature_per_m = 0;  // of a leg, left positive; 0: the legs are straight
  double E_d = 1, E_b = 1;
};

/// Borenstein & Feng: x_cg and y_cg of a closed square of side L, to first order in alpha and beta.
SquareAngles angles_from_positions(const MeanErrors& mean, double side_m, AngleSource source);

/// Jung & Chung: four spins and four legs add up to the end heading; exact for any size of the angles.
SquareAngles angles_from_headings(const MeanErrors& mean);

/// UMBmark as printed: curvature = 2 sin(beta / 2) / L, E_d with the wheelbase of the odometry.
Ratios umbmark_ratios(const MeanErrors& mean, double side_m, double b_m, AngleSource source);

/// Extended UMBmark. exact: curvature = beta / L (L is an arc length) and no alpha_Ed.
Ratios extended_ratios(const MeanErrors& mean, double side_m, double b_m, Formula formula);

}  // namespace astro::calibration
