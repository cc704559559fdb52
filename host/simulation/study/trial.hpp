#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/simulation/study/drive_source.hpp"
#include "host/simulation/study/setup.hpp"

/// One trial: the squares and circles are driven once, and every method calibrates from the same data.
namespace astro::simulation::study {

/// The methods in the order of the table.
inline constexpr std::array<std::string_view, 6> kMethods = {
    "uncalibrated", "umbmark thesis", "umbmark average", "extended published", "extended exact", "ml",
};
inline constexpr std::size_t kMl = 5;

/// Errors of a set of factors. The first four are differences of E_d, of b / S over the nominal wheelbase, of
/// S and of e. The others are the noise-free errors that remain when the factors are loaded: E_max_syst of
/// the square; the heading error at its end (rms of both directions); and, after a straight line of 10 m by
/// odometry, the distance between the true end and the end by odometry.
enum Figure : std::size_t { kE_d, kB_over_S, kScale, kCurvature, kE_max_m, kTheta_rad, kLine_m };
inline constexpr std::size_t kFigures = 7;
using Errors = std::array<double, kFigures>;

/// Errors of `found` against the true factors of `setup`; the first four are signed.
Errors errors_of(const calibration::WheelFactors& found, const TrialSetup& setup);

struct Trial {
  int index = 0;
  /// The errors of each method; empty if it gave no answer.
  std::array<std::optional<Errors>, kMethods.size()> errors;
  /// x' C^-1 x, where x are the errors of c_R, c_L and b, and of e if it was estimated, and C is the
  /// covariance that maximum likelihood states.
  std::optional<double> ml_chi_square;
  int ml_unknowns = 3;           // in ml_chi_square: 4 with e
  std::optional<double> ml_K_m;  // the slip that maximum likelihood found; none if it was given
  std::string failure;           // why the last method without an answer gave none: "ml: sentence"

  bool operator==(const Trial&) const = default;
};

/// Errors  none. If `source` or a method throws astro::Error, this is recorded as `failure`.
/// Cost    that of driving and of estimate_ml: about 0.3 s for ten squares.
Trial run_trial(const TrialSetup& setup, const DriveSource& source, int index);

}  // namespace astro::simulation::study
