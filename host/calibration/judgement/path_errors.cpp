#include "host/calibration/judgement/path_errors.hpp"

#include <cmath>
#include <numbers>

#include "host/calibration/likelihood/ml_fit.hpp"
#include "host/calibration/preparation/path_alignment.hpp"

namespace astro::calibration {
namespace {

/// Accumulates a root mean square.
struct SquareSum {
  double sum = 0, count = 0;
  void add(double value) {
    sum += value * value;
    ++count;
  }
  double rms() const { return std::sqrt(sum / count); }
};

/// Pose of the tracked body by an odometry that starts at (0, 0, 0).
Pose2 placed(const Pose2& odometry, const Unknowns& u) {
  return Pose2{u[kStartX], u[kStartY], u[kStartTheta]} * odometry * lever_of(u);
}

}  // namespace

double rms_standard_error(double rms, std::size_t count) {
  return rms / std::sqrt(2 * static_cast<double>(count));
}

double expected_end_error_m2(const FactorCovariance& changes, const WheelFactors& factors) {
  constexpr double kSide_m = 2, kTurn_rad = 2 * std::numbers::pi;
  const double scale = (factors.c_r + factors.c_l) / 2, turned = 4 * kSide_m / factors.b_m / scale;
  const Eigen::RowVector4d by_ratio(turned, -turned, 0, 0);
  const Eigen::RowVector4d by_base(kTurn_rad / 2 / scale, kTurn_rad / 2 / scale, -kTurn_rad / factors.b_m, 0);
  const Eigen::RowVector4d by_scale(0.5, 0.5, 0, 0);
  // The products of ratio and wheelbase cancel, because these act with opposite signs in the two directions.
  const auto square = [&](const Eigen::RowVector4d& jacobian, double length_m) {
    return length_m * length_m * (jacobian * changes).dot(jacobian);
  };
  return square(by_ratio, kSide_m) + square(by_base, kSide_m) + square(by_scale, 4 * kSide_m);
}

PathErrors path_errors(const MlFit& fit, const WheelFactors& factors) {
  PathErrors errors;
  SquareSum final_m, heading_rad, path_m;
  for (std::size_t i = 0; i < fit.runs().size(); ++i) {
    const PreparedRun& run = fit.runs()[i];
    const Unknowns& u = fit.unknowns()[i];
    RunErrors of_run{run.source->name};
    SquareSum run_m;
    const std::vector<BodySample> odometry = dead_reckoned(run, {u[kClockOffset], u[kSkew]}, factors);
    for (std::size_t k = 0; k < odometry.size(); ++k) {
      const Pose2 error = difference(placed(pose_of(odometry[k]), u), pose_of(run.truth[k]));
      const double miss_m = std::hypot(error.x_m, error.y_m);
      run_m.add(miss_m);
      path_m.add(miss_m);
      if (k + 1 < odometry.size()) continue;
      of_run.final_m = miss_m;
      of_run.final_heading_rad = run.has_headings ? error.theta_rad : std::nan("");
    }
    of_run.path_rms_m = run_m.rms();
    final_m.add(of_run.final_m);
    if (run.has_headings) heading_rad.add(of_run.final_heading_rad);
    errors.runs.push_back(of_run);
  }
  errors.final_rms_m = final_m.rms();
  errors.final_heading_rms_rad = heading_rad.rms();
  errors.path_rms_m = path_m.rms();
  return errors;
}

PathErrors path_errors(std::span<const Trajectory> runs, const WheelFactors& factors,
                       const MlOptions& options) {
  PreparedRuns prepared = prepare(runs, factors, options.clock_known, Density::independent);
  // All samples of a spin are offered: the factors are given, so the wind-up in a spin cannot be taken for another wheelbase,
  // and samples in spins show lever arm and clock best.
  for (PreparedRun& run : prepared.runs) run.knots_m = run.path_m;
  PathErrors errors = path_errors(MlFit::of(prepared, factors, options, {.factors = true}), factors);
  errors.left_out = prepared.left_out;
  return errors;
}

}  // namespace astro::calibration
