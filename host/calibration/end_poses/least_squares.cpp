#include "host/calibration/end_poses/least_squares.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "host/base/error.hpp"
#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/compose.hpp"
#include "host/calibration/end_poses/replay.hpp"

namespace astro::calibration {
namespace {

using Parameters = Eigen::Vector2d;  // ln E_d, ln E_b, so that no step makes a ratio negative
using Residuals = Eigen::Vector4d;
using Jacobian = Eigen::Matrix<double, 4, 2>;

struct Problem {
  const MeanErrors& mean;
  double side_m;
  const WheelFactors& loaded;
  double weight_cw, weight_ccw;

  Residuals operator()(const Parameters& p) const {
    const WheelFactors truth = compose(loaded, std::exp(p(0)), std::exp(p(1)));
    const EndPose cw = replay_square(side_m, Sense::cw, loaded, truth);
    const EndPose ccw = replay_square(side_m, Sense::ccw, loaded, truth);
    return {weight_cw * (cw.x_m - mean.cw.x_m), weight_cw * (cw.y_m - mean.cw.y_m),
            weight_ccw * (ccw.x_m - mean.ccw.x_m), weight_ccw * (ccw.y_m - mean.ccw.y_m)};
  }

  Jacobian derivative(const Parameters& p) const {
    constexpr double kStep =
        1e-5;  // errors of 1e-11 by rounding and 1e-10 by curvature, far below the fit's own error
    Jacobian out;
    for (int column = 0; column < 2; ++column) {
      const Parameters step = kStep * Parameters::Unit(column);
      out.col(column) = ((*this)(p + step) - (*this)(p - step)) / (2 * kStep);
    }
    return out;
  }
};

Parameters start(const MeanErrors& mean, double side_m, double b_m) {
  const Ratios guess = umbmark_ratios(mean, side_m, b_m, AngleSource::average);
  const bool usable = guess.E_d > 0.5 && guess.E_d < 2 && guess.E_b > 0.5 && guess.E_b < 2;
  return usable ? Parameters(std::log(guess.E_d), std::log(guess.E_b)) : Parameters::Zero();
}

Parameters solve(const Problem& problem, Parameters p) {
  constexpr int kMostSteps = 50;
  constexpr double kSettled = 1e-13;
  for (int i = 0; i < kMostSteps; ++i) {
    // The normal equations square the condition number, so their step is rounded more than that of an orthogonal
    // decomposition. That costs at most another step: the iteration ends where the slope vanishes. Where the
    // curvature is singular, the step is not finite, and the loop ends below.
    const Jacobian jacobian = problem.derivative(p);
    const Parameters slope = jacobian.transpose() * problem(p);
    const Eigen::Matrix2d curvature = jacobian.transpose() * jacobian;
    const Parameters step = -curvature.inverse() * slope;
    p += step;
    if (step.norm() < kSettled) return p;
    if (!p.allFinite() || p.norm() > 1) break;
  }
  throw Error("no pair of wheel and wheelbase ratios explains these end positions",
              {Help::check_units_and_directions});
}

}  // namespace

Ratios fit_end_positions(const MeanErrors& mean, RunCounts runs, double side_m, const WheelFactors& loaded) {
  const Problem problem{mean, side_m, loaded, std::sqrt(runs.cw), std::sqrt(runs.ccw)};
  const Parameters p = solve(problem, start(mean, side_m, loaded.b_m));

  Ratios out{.E_d = std::exp(p(0)), .E_b = std::exp(p(1))};
  const WheelFactors truth = compose(loaded, out.E_d, out.E_b);
  const double right = truth.c_r / loaded.c_r;
  const double left = truth.c_l / loaded.c_l;
  out.alpha_rad = std::numbers::pi / 2 * (1 - (right + left) / 2 / out.E_b);
  out.beta_rad = side_m * (right - left) / truth.b_m;
  out.curvature_per_m = (right - left) / truth.b_m / ((right + left) / 2);
  return out;
}

}  // namespace astro::calibration
