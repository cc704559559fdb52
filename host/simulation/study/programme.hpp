#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "host/base/error.hpp"
#include "host/calibration/judgement/precision.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/motion/trajectory.hpp"

/// Computes the precision that a programme of drives will give before anything is driven.
namespace astro::simulation::study {

/// Kinds of run. A square is four lines and four turns on the spot; a spin turns on the spot; a circle is one
/// full turn.
enum Kind : std::size_t { kSquares, kLines, kSpins, kCircles };
inline constexpr std::size_t kKinds = 4;
inline constexpr int kMostRuns = 1000;  // of a programme
inline constexpr std::array<std::string_view, kKinds> kKindNames = {"squares", "lines", "spins", "circles"};

/// Number of runs of each kind. Half of the turning runs are clockwise; of an odd number, the larger half.
/// Lines are driven forwards.
using Counts = std::array<int, kKinds>;

/// What a programme cannot determine or exceeds. The value of too_many_runs is how many it has.
enum class ProgrammeProblem {
  no_runs,
  lines_alone,
  spins_alone,
  one_circle,
  no_circles,
  no_squares_nor_spins,
  too_many_runs,
  precision_too_fine
};

/// Why these runs, of any size, cannot determine all three factors; nothing if they can.
std::optional<Remark> why_undetermined(const Counts& counts);

/// Why these runs, of any size, hardly show e, the difference between the wheelbase of gentle arcs and that of spins; nothing
/// if they show it.
std::optional<std::string> why_e_is_hidden(const Counts& counts);

/// Sizes of the runs, how they are driven and what is measured. The clock offset counts as unknown, as in the
/// estimator.
struct Programme {
  Counts counts{};
  double side_m = 3, line_m = 3, turns = 5, radius_m = 1;
  double wheelbase_m = 0.290;
  calibration::NoiseModel noise{2.645e-6, 5e-4, 0.0026179938779914943};  // 0.15 degrees
  double truth_rate_hz = 60, count_rate_hz = 100;
  double speed_mps = 0.3, yaw_rate_radps = 1.0;
  bool with_e = false;  // the precision of e is asked for as well

  /// The same with other numbers of runs.
  Programme with(const Counts& other) const;
  /// "4 squares of 3 m, 2 circles of radius 1 m".
  std::string text() const;
};

struct Forecast {
  Programme programme;
  // For a robot without errors: c_R = c_L = S = E_d = 1. If the runs do not show e, its
  // standard error is what is known without any runs, 0.02.
  calibration::FactorCovariance covariance = calibration::FactorCovariance::Zero();
  calibration::MlErrors se;
  calibration::DriveExtent extent;  // distance of the robot's centre, and the sum of |rotation|
  double driving_time_s = 0;  // with a second of rest at each end of a run, without the way between runs
  calibration::Precision relative() const { return {se.E_d, se.scale, se.b_m / programme.wheelbase_m}; }
};

/// Standard errors by the Cramer-Rao bound, which maximum likelihood reaches within a few percent.
///
/// Throws astro::Error where cramer_rao_bound does; for a programme without runs; for lines alone, spins
/// alone or one circle alone, which leave a factor undetermined; for sizes and rates that are not positive;
/// and for more than kMostRuns.
///
/// Cost    about 10 ms for each different run and 5 ms for each further one.
Forecast forecast(const Programme& programme);

}  // namespace astro::simulation::study
