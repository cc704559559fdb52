#include "host/simulation/study/trial.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "host/base/error.hpp"
#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/replay.hpp"
#include "host/calibration/end_poses/umbmark.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/motion/arc.hpp"

namespace astro::simulation::study {
namespace {

using calibration::EndPose;

using calibration::WheelFactors;

constexpr double kLineLength_m = 10;

double line_miss_m(const WheelFactors& loaded, const WheelFactors& actual) {
  Pose2 end;
  calibration::advance(end, kLineLength_m / loaded.c_r, kLineLength_m / loaded.c_l, actual);
  return std::hypot(end.x_m - kLineLength_m, end.y_m);
}

double heading_rms_rad(double side_m, const WheelFactors& loaded, const WheelFactors& actual) {
  const auto turn = [&](Sense sense) { return replay_square(side_m, sense, loaded, actual).theta_rad; };
  return std::hypot(turn(Sense::cw), turn(Sense::ccw)) / std::numbers::sqrt2;
}

/// The end errors of the squares by direction, as UMBmark needs them.
struct EndErrors {
  std::vector<EndPose> cw, ccw;
};

EndErrors by_sense(const std::vector<EndPose>& errors) {
  EndErrors ends;
  for (std::size_t run = 0; run < errors.size(); ++run)
    (sense_of(static_cast<int>(run)) == Sense::cw ? ends.cw : ends.ccw).push_back(errors[run]);
  return ends;
}

WheelFactors by_end_poses(const TrialSetup& setup, const EndErrors& ends,
                          const calibration::Options& options) {
  return estimate_factors(ends.cw, ends.ccw, setup.side_m, setup.loaded(), options).factors;
}

int unknowns_of(const calibration::MlEstimate& estimate) { return estimate.se.e > 0 ? 4 : 3; }

template <int kUnknowns>
double normalised_square(const calibration::MlEstimate& estimate, const WheelFactors& actual) {
  const Eigen::Vector4d error(estimate.factors.c_r - actual.c_r, estimate.factors.c_l - actual.c_l,
                              estimate.factors.b_m - actual.b_m, estimate.factors.e - actual.e);
  const Eigen::Matrix<double, kUnknowns, 1> of_unknowns = error.head<kUnknowns>();
  const Eigen::Matrix<double, kUnknowns, kUnknowns> covariance =
      estimate.covariance.topLeftCorner<kUnknowns, kUnknowns>();
  return of_unknowns.dot(covariance.ldlt().solve(of_unknowns));
}

}  // namespace

Errors errors_of(const WheelFactors& found, const TrialSetup& setup) {
  const WheelFactors actual = setup.actual();
  const double scale = (found.c_r + found.c_l) / 2;
  return {found.c_r / found.c_l - setup.E_d,
          found.b_m / scale / setup.wheelbase_m - setup.E_b,
          scale - setup.scale,
          found.e - actual.e,
          replay_E_max_syst_m(setup.side_m, found, actual),
          heading_rms_rad(setup.side_m, found, actual),
          line_miss_m(found, actual)};
}

Trial run_trial(const TrialSetup& setup, const DriveSource& source, int index) {
  using calibration::AngleSource;
  using calibration::Formula;
  using calibration::Method;
  Trial trial;
  trial.index = index;
  Drives drives;
  try {
    drives = source.of_trial(setup, index);
  } catch (const Error& error) {
    trial.failure = std::string(kMethods[0]) + ": " + error.what();
    return trial;
  }
  const EndErrors ends = by_sense(drives.end_errors);
  std::size_t method = 0;
  const auto attempt = [&](auto estimate) {
    try {
      trial.errors[method] = errors_of(estimate(), setup);
    } catch (const Error& error) {
      trial.failure = std::string(kMethods[method]) + ": " + error.what();
    }
    ++method;
  };
  attempt([&] { return setup.loaded(); });
  for (const calibration::Options& options : {calibration::Options{Method::umbmark, AngleSource::thesis, {}},
                                              calibration::Options{Method::umbmark, AngleSource::average, {}},
                                              calibration::Options{Method::extended, {}, Formula::published},
                                              calibration::Options{Method::extended, {}, Formula::exact}})
    attempt([&] { return by_end_poses(setup, ends, options); });
  attempt([&] {
    const calibration::MlEstimate estimate = estimate_ml(drives.runs, setup.loaded(), setup.ml_options());
    trial.ml_unknowns = unknowns_of(estimate);
    trial.ml_chi_square = trial.ml_unknowns == 4 ? normalised_square<4>(estimate, setup.actual())
                                                 : normalised_square<3>(estimate, setup.actual());
    if (!setup.noise_known) trial.ml_K_m = estimate.noise.K_m;
    return estimate.factors;
  });
  return trial;
}

}  // namespace astro::simulation::study
