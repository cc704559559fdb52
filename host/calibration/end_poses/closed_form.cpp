#include "host/calibration/end_poses/closed_form.hpp"

#include <cmath>
#include <numbers>

namespace astro::calibration {
namespace {

using std::numbers::pi;

double wheelbase_ratio(double alpha_rad) { return (pi / 2) / (pi / 2 - alpha_rad); }

/// (R + b/2) / (R - b/2) written with 1/R, so that straight legs are an ordinary case.
double diameter_ratio(double curvature_per_m, double b_m) {
  const double half = curvature_per_m * b_m / 2;
  return (1 + half) / (1 - half);
}

double curvature_of_chord(double beta_rad, double side_m) { return 2 * std::sin(beta_rad / 2) / side_m; }

}  // namespace

SquareAngles angles_from_positions(const MeanErrors& mean, double side_m, AngleSource source) {
  const double scale = -4 * side_m;
  const SquareAngles x{(mean.cw.x_m + mean.ccw.x_m) / scale, (mean.cw.x_m - mean.ccw.x_m) / scale};
  const SquareAngles y{(mean.cw.y_m - mean.ccw.y_m) / scale, (mean.cw.y_m + mean.ccw.y_m) / scale};
  switch (source) {
    case AngleSource::x:
      return x;
    case AngleSource::y:
      return y;
    case AngleSource::thesis:
      return {x.alpha_rad, y.beta_rad};
    case AngleSource::average:
      break;
  }
  return {(x.alpha_rad + y.alpha_rad) / 2, (x.beta_rad + y.beta_rad) / 2};
}

SquareAngles angles_from_headings(const MeanErrors& mean) {
  return {(mean.cw.theta_rad - mean.ccw.theta_rad) / 8, (mean.cw.theta_rad + mean.ccw.theta_rad) / 8};
}

Ratios umbmark_ratios(const MeanErrors& mean, double side_m, double b_m, AngleSource source) {
  const SquareAngles angles = angles_from_positions(mean, side_m, source);
  Ratios out{.alpha_rad = angles.alpha_rad, .beta_rad = angles.beta_rad};
  out.curvature_per_m = curvature_of_chord(angles.beta_rad, side_m);
  out.E_b = wheelbase_ratio(angles.alpha_rad);
  out.E_d = diameter_ratio(out.curvature_per_m, b_m);
  return out;
}

Ratios extended_ratios(const MeanErrors& mean, double side_m, double b_m, Formula formula) {
  const SquareAngles angles = angles_from_headings(mean);
  Ratios out{.alpha_rad = angles.alpha_rad, .beta_rad = angles.beta_rad};
  if (formula == Formula::published) {
    out.alpha_Ed_rad = pi * b_m / (4 * side_m) * angles.beta_rad;
    out.curvature_per_m = curvature_of_chord(angles.beta_rad, side_m);
  } else {
    out.curvature_per_m = angles.beta_rad / side_m;
  }
  out.E_b = wheelbase_ratio(angles.alpha_rad + out.alpha_Ed_rad);
  out.E_d = diameter_ratio(out.curvature_per_m, out.E_b * b_m);
  return out;
}

}  // namespace astro::calibration
