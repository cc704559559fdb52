#include "host/calibration/end_poses/umbmark.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/compose.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"
#include "host/calibration/end_poses/replay.hpp"
#include "host/calibration/end_poses/robust_fit.hpp"

namespace astro::calibration {
namespace {

/// How often each direction was driven: the weights of the two means.
struct RunCounts {
  int cw = 0, ccw = 0;
};

using Parameters = Eigen::Vector2d;  // ln E_d, ln E_b, so that no step makes a ratio negative
using Residuals = Eigen::Vector4d;
using PositionJacobian = Eigen::Matrix<double, 4, 2>;

/// What the fit minimises: the difference of the exact replay of both directions from the measured end positions, each weighted
/// by how often it was driven.
struct EndPositions {
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

  PositionJacobian derivative(const Parameters& p) const {
    constexpr double kStep =
        1e-5;  // errors of 1e-11 by rounding and 1e-10 by curvature, far below the fit's own error
    PositionJacobian out;
    for (int column = 0; column < 2; ++column) {
      const Parameters step = kStep * Parameters::Unit(column);
      out.col(column) = ((*this)(p + step) - (*this)(p - step)) / (2 * kStep);
    }
    return out;
  }
};

Parameters first_guess(const MeanErrors& mean, double side_m, double b_m) {
  const Ratios guess = umbmark_ratios(mean, side_m, b_m, AngleSource::average);
  const bool usable = guess.E_d > 0.5 && guess.E_d < 2 && guess.E_b > 0.5 && guess.E_b < 2;
  return usable ? Parameters(std::log(guess.E_d), std::log(guess.E_b)) : Parameters::Zero();
}

Parameters best_fit(const EndPositions& positions, Parameters p) {
  constexpr int kMostSteps = 50;
  constexpr double kSettled = 1e-13;
  for (int i = 0; i < kMostSteps; ++i) {
    // The normal equations square the condition number, so their step is rounded more than that of an orthogonal
    // decomposition. That costs at most another step: the iteration ends where the slope vanishes. Where the
    // curvature is singular, the step is not finite, and the loop ends below.
    const PositionJacobian jacobian = positions.derivative(p);
    const Parameters slope = jacobian.transpose() * positions(p);
    const Eigen::Matrix2d curvature = jacobian.transpose() * jacobian;
    const Parameters step = -curvature.inverse() * slope;
    p += step;
    if (step.norm() < kSettled) return p;
    if (!p.allFinite() || p.norm() > 1) break;
  }
  throw Error(
      "no pair of wheel and wheelbase ratios explains these end positions: check the units, the side length "
      "and that the clockwise and counter-clockwise runs are not exchanged",
      EndPoseProblem::no_ratios_fit);
}

/// The E_d and E_b whose exact replay (replay.hpp) comes closest to the measured end positions, in the sense
/// of the sum of squared distances over all runs. Headings are not used. The scale c_R + c_L stays as
/// loaded, because closed squares do not observe it.
///
/// Unlike umbmark_ratios it has no small-angle bias: noise-free end positions give the true ratios back.
/// Returns the ratios; alpha, beta and the curvature are those of the fitted robot.
/// Errors  throws astro::Error if the iteration does not converge, which only implausible end poses cause.
/// Cost    Gauss-Newton, about 5 steps of 5 replays.
Ratios fit_end_positions(const MeanErrors& mean, RunCounts runs, double side_m, const WheelFactors& loaded) {
  const EndPositions positions{mean, side_m, loaded, std::sqrt(runs.cw), std::sqrt(runs.ccw)};
  const Parameters p = best_fit(positions, first_guess(mean, side_m, loaded.b_m));

  Ratios out{.E_d = std::exp(p(0)), .E_b = std::exp(p(1))};
  const WheelFactors truth = compose(loaded, out.E_d, out.E_b);
  const double right = truth.c_r / loaded.c_r;
  const double left = truth.c_l / loaded.c_l;
  out.alpha_rad = std::numbers::pi / 2 * (1 - (right + left) / 2 / out.E_b);
  out.beta_rad = side_m * (right - left) / truth.b_m;
  out.curvature_per_m = (right - left) / truth.b_m / ((right + left) / 2);
  return out;
}

using Vector5 = Eigen::Matrix<double, 5, 1>;  // E_d, E_b, c_R, c_L, b
using Vector6 = Eigen::Matrix<double, 6, 1>;  // x, y, theta of cw, then of ccw
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct Experiment {
  double side_m;
  const WheelFactors& loaded;
  const Options& options;
  RunCounts runs;

  Ratios ratios(const Vector6& m) const {
    const MeanErrors mean{{m(0), m(1), m(2)}, {m(3), m(4), m(5)}};
    switch (options.method) {
      case Method::extended:
        return extended_ratios(mean, side_m, loaded.b_m, options.formula);
      case Method::least_squares:
        return fit_end_positions(mean, runs, side_m, loaded);
      case Method::umbmark:
      case Method::robust:  // does not fit means
        break;
    }
    return umbmark_ratios(mean, side_m, loaded.b_m, options.angles);
  }

  Vector5 results(const Vector6& m) const {
    const Ratios r = ratios(m);
    const WheelFactors f = compose(loaded, r.E_d, r.E_b);
    return (Vector5() << r.E_d, r.E_b, f.c_r, f.c_l, f.b_m).finished();
  }
};

void require_inputs(std::span<const EndPose> cw, std::span<const EndPose> ccw, double side_m,
                    const WheelFactors& loaded) {
  if (!std::isfinite(side_m) || side_m <= 0) {
    throw Error("the side of the square is " + to_text(side_m) +
                    " m, and has to be the length of one leg in metres, such as 3",
                EndPoseProblem::bad_side, {to_text(side_m)});
  }
  require_usable(loaded);
  if (cw.empty() && ccw.empty()) {
    throw Error(
        "there are no runs at all: drive the square at least once clockwise and once counter-clockwise",
        EndPoseProblem::no_runs);
  }
  if (cw.empty() || ccw.empty()) {
    const std::string missing = in_words(cw.empty() ? Sense::cw : Sense::ccw);
    throw Error("there are no " + missing +
                    " runs, and one direction alone cannot separate the error of the wheel diameters from "
                    "that of the "
                    "wheelbase: drive the square at least once clockwise and once counter-clockwise",
                EndPoseProblem::one_direction_only, {missing});
  }
}

void require_headings(std::span<const EndPose> runs, const std::string& direction) {
  const auto lacks = [](const EndPose& run) { return std::isnan(run.theta_rad); };
  const bool none = std::all_of(runs.begin(), runs.end(), lacks);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string number = std::to_string(i + 1), run = direction + " run " + number;
    if (lacks(runs[i])) {
      throw Error(
          (none ? "the " + direction + " runs have" : run + " has") +
              " no heading error, which the extended method calibrates from: measure the end headings "
              "(etheta_rad or etheta_deg), or use the method umbmark",
          none ? EndPoseProblem::no_headings : EndPoseProblem::no_heading,
          none ? std::vector{direction} : std::vector{direction, number});
    }
    if (std::abs(runs[i].theta_rad) > std::numbers::pi) {
      throw Error(
          run + " has a heading error of " + to_text(runs[i].theta_rad) +
              " rad, more than half a turn, outside the range of -180 to 180 degrees: check the units",
          EndPoseProblem::heading_beyond_half_a_turn, {direction, number, to_text(runs[i].theta_rad)});
    }
  }
}

void require_plausible(const Ratios& r) {
  const auto plausible = [](double ratio) { return ratio > 0.5 && ratio < 2; };
  if (plausible(r.E_d) && plausible(r.E_b)) return;
  throw Error("the end poses give E_d = " + std::to_string(r.E_d) + " and E_b = " + std::to_string(r.E_b) +
                  ", and a robot that drives a square has both between 0.5 and 2: check the units, the side "
                  "length and that the clockwise and counter-clockwise runs are not exchanged",
              EndPoseProblem::implausible_ratios, {std::to_string(r.E_d), std::to_string(r.E_b)});
}

Vector6 means_of(const ExperimentSummary& s) {
  const auto theta = [](const ClusterSummary& c) { return c.has_theta ? c.theta_cg_rad : 0; };
  return (Vector6() << s.cw.x_cg_m, s.cw.y_cg_m, theta(s.cw), s.ccw.x_cg_m, s.ccw.y_cg_m, theta(s.ccw))
      .finished();
}

/// Covariance of the mean of one direction. A heading that was not measured is zero without variance.
Eigen::Matrix3d covariance_of_mean(std::span<const EndPose> runs) {
  Eigen::Matrix3Xd deviations(3, static_cast<Eigen::Index>(runs.size()));
  for (Eigen::Index i = 0; i < deviations.cols(); ++i) {
    const EndPose& run = runs[static_cast<std::size_t>(i)];
    deviations.col(i) << run.x_m, run.y_m, std::isnan(run.theta_rad) ? 0 : run.theta_rad;
  }
  deviations.colwise() -= deviations.rowwise().mean().eval();
  const double n = static_cast<double>(runs.size());
  return deviations * deviations.transpose() / (n * (n - 1));  // 0 / 0 = NaN for one run, as documented
}

/// Delta method: J C J^T with a central difference for J. The step makes J wrong by 1e-9 through rounding and
/// by less through curvature.
StandardErrors standard_errors(const Experiment& experiment, const Vector6& mean, const Matrix6& covariance) {
  constexpr double kStep = 1e-5;  // of the side, or radians
  Eigen::Matrix<double, 5, 6> jacobian;
  for (int column = 0; column < 6; ++column) {
    const double h = column % 3 == 2 ? kStep : kStep * experiment.side_m;
    const Vector6 step = h * Vector6::Unit(column);
    jacobian.col(column) = (experiment.results(mean + step) - experiment.results(mean - step)) / (2 * h);
  }
  const Vector5 se = (jacobian * covariance * jacobian.transpose()).diagonal().cwiseSqrt();
  return {se(0), se(1), se(2), se(3), se(4)};
}

void take(Estimate& out, const Ratios& ratios) {
  require_plausible(ratios);
  out.alpha_rad = ratios.alpha_rad;
  out.beta_rad = ratios.beta_rad;
  out.alpha_Ed_rad = ratios.alpha_Ed_rad;
  out.radius_m = 1 / ratios.curvature_per_m;
  out.E_d = ratios.E_d;
  out.E_b = ratios.E_b;
  out.factors = compose(out.loaded, ratios.E_d, ratios.E_b);
}

/// c_R and c_L share the change of ln E_d, and their sum stays.
StandardErrors standard_errors(const RobustFit& fit, const WheelFactors& factors) {
  const double ln_E_d = std::sqrt(fit.covariance(0, 0)), ln_E_b = std::sqrt(fit.covariance(1, 1));
  const double c = factors.c_r * factors.c_l / (factors.c_r + factors.c_l) * ln_E_d;
  return {fit.E_d * ln_E_d, fit.E_b * ln_E_b, c, c, factors.b_m * ln_E_b};
}

void estimate_robustly(Estimate& out, std::span<const EndPose> cw, std::span<const EndPose> ccw) {
  const SquareSetup setup{out.side_m, out.loaded};
  const RobustFit fit = fit_ends(cw, ccw, setup);
  take(out, ratios_of(fit, setup));
  out.se = standard_errors(fit, out.factors);
}

/// Estimates by a method that takes the mean ends of both directions.
void estimate_from_means(Estimate& out, std::span<const EndPose> cw, std::span<const EndPose> ccw) {
  const Experiment experiment{
      out.side_m, out.loaded, out.options, {out.summary.cw.runs, out.summary.ccw.runs}};
  const Vector6 mean = means_of(out.summary);
  take(out, experiment.ratios(mean));
  Matrix6 covariance = Matrix6::Zero();
  covariance.topLeftCorner<3, 3>() = covariance_of_mean(cw);
  covariance.bottomRightCorner<3, 3>() = covariance_of_mean(ccw);
  out.se = standard_errors(experiment, mean, covariance);
}

}  // namespace

Estimate estimate_factors(std::span<const EndPose> cw, std::span<const EndPose> ccw, double side_m,
                          const WheelFactors& loaded, const Options& options) {
  require_inputs(cw, ccw, side_m, loaded);
  Estimate out;
  out.options = options;
  out.side_m = side_m;
  out.loaded = loaded;
  out.summary = summarize(cw, ccw);
  if (options.method == Method::extended) {
    require_headings(cw, in_words(Sense::cw));
    require_headings(ccw, in_words(Sense::ccw));
  }
  if (options.method == Method::robust) {
    estimate_robustly(out, cw, ccw);
  } else {
    estimate_from_means(out, cw, ccw);
  }
  return out;
}

std::string_view name_of(Method method) {
  switch (method) {
    case Method::umbmark:
      return "umbmark";
    case Method::extended:
      return "extended";
    case Method::least_squares:
      return "least-squares";
    case Method::robust:
      break;
  }
  return "robust";
}

std::string_view name_of(AngleSource angles) {
  switch (angles) {
    case AngleSource::x:
      return "x";
    case AngleSource::y:
      return "y";
    case AngleSource::thesis:
      return "thesis";
    case AngleSource::average:
      break;
  }
  return "average";
}

std::string_view name_of(Formula formula) { return formula == Formula::exact ? "exact" : "published"; }

}  // namespace astro::calibration
