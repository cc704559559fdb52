#pragma once

#include <span>
#include <string_view>

#include "host/calibration/end_poses/closed_form.hpp"
#include "host/calibration/end_poses/end_pose.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// Wheel factors from the end poses of squares driven both ways round: UMBmark (Borenstein & Feng 1996),
/// extended UMBmark (Jung & Chung 2011), the exact fit of the end positions, and the robust fit of whole ends.
namespace astro::calibration {

/// umbmark        end positions, first order in the angles; `angles` says which coordinates
/// extended       end headings; `formula` says exact or as published
/// least_squares  end positions, exact arcs, no small-angle bias
/// robust         end positions and the headings of the runs that have one, exact arcs, weighted by how slip scatters them; a
///                run that is far from the others counts little
enum class Method { umbmark, extended, least_squares, robust };

struct Options {
  Method method = Method::umbmark;
  AngleSource angles = AngleSource::average;  // read by Method::umbmark
  Formula formula = Formula::exact;           // read by Method::extended
};

/// Standard errors from the scatter of the runs within each direction, to first order. All NaN with fewer than two runs in a
/// direction: one run shows no scatter. Method::robust takes the scatter about its fit, which has a prior, so it has standard
/// errors for single runs, too. They do not include the bias of the method, the error of the side length, or the uncertainty of
/// the loaded factors.
struct StandardErrors {
  double E_d = 0, E_b = 0, c_r = 0, c_l = 0, b_m = 0;
};

struct Estimate {
  Options options;
  double side_m = 0;
  WheelFactors loaded;  // the factors of the odometry during the runs

  double alpha_rad = 0, beta_rad = 0, alpha_Ed_rad = 0;  // see closed_form.hpp
  double radius_m = 0;  // of a leg: positive curves to the left, infinite when beta is 0
  double E_d = 1, E_b = 1;
  WheelFactors factors;  // what to load: E_d and E_b composed with `loaded`, see compose.hpp
  StandardErrors se;
  ExperimentSummary summary;
};

/// `side_m` is the leg as the odometry measured it. `loaded` are the factors in force during all of the
/// runs; for a nominal robot {1, 1, nominal wheelbase}.
///
/// Throws astro::Error if
///   a direction is missing or a value is not finite
///   the method is extended and a run has no heading, or one beyond half a turn
///   the side or a loaded factor is not positive and finite
///   a ratio is outside 0.5..2, which means wrong units, side or sets
Estimate estimate_factors(std::span<const EndPose> cw, std::span<const EndPose> ccw, double side_m,
                          const WheelFactors& loaded, const Options& options = {});

/// The names users type and read: "umbmark", "extended", "least-squares", "robust"; "x", "y", "thesis", "average";
/// "exact", "published".
std::string_view name_of(Method method);
std::string_view name_of(AngleSource angles);
std::string_view name_of(Formula formula);

}  // namespace astro::calibration
