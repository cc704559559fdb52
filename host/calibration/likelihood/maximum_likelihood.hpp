#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/remedy.hpp"
#include "host/calibration/likelihood/slip_events.hpp"
#include "host/calibration/likelihood/unknowns.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Wheel factors by maximum likelihood from whole trajectories.
///
/// Unknown are c_R, c_L, b; the lever arm of the tracked body; per run its start pose and the offset between
/// the two clocks; one skew of the clocks; and the noise itself. A Kalman filter runs along each drive
/// (innovation.hpp), its innovations are made as likely as they can be by Gauss-Newton, with Huber's weights
/// against outliers. For normal noise that is the maximum-likelihood estimate, and it reaches the Cramer-Rao
/// bound within a few percent.
///
/// Frames  see trajectory.hpp. Factors are absolute: wheel travel = c * nominal travel, whatever the robot
///         loaded while it drove, so a calibration of a calibrated robot composes by itself.
/// Source  Kalman innovations as likelihood: Schweppe 1965; start: Censi et al. 2013 (relative_pose.hpp).
namespace astro::calibration {

struct MlOptions {
  /// True: the truth's times are already the robot's, and neither offset nor skew is estimated.
  bool clock_known = false;
  /// A given noise model is used as it stands; without one it is estimated.
  std::optional<NoiseModel> noise;
  /// With a given noise model: every so many-th truth sample counts, because closer ones are not independent
  /// (MlEstimate::stride). Without one it is found.
  int stride = 1;
  /// Huber's loss for slips and for truth samples. Off: least squares, for comparison.
  bool robust = true;
};

/// Of c_R, c_L and b in this order; b in metres.
using FactorCovariance = Eigen::Matrix3d;

/// Standard errors of the factors and of the ratios that people use: E_d = c_R / c_L, S = (c_R + c_L) / 2.
struct MlErrors {
  double c_r = 0, c_l = 0, b_m = 0;
  double E_d = 0, scale = 0;
  double b_over_scale_m = 0;  // b / S: what squares driven by odometry determine of b
};

struct RunFit {
  std::string name;
  double distance_m = 0,
         rotation_rad = 0;    // driven while truth covers it; the rotation is the sum of its magnitudes
  double clock_offset_s = 0;  // robot's clock less tracker's, in the middle of the run; 0 if known
  double clock_offset_se_s = 0;
  double chi_square = 0;  // of the innovations
  int degrees_of_freedom = 0;
  /// How far this run, without down-weighting its slips, is from all other runs in c_R, c_L and b: chi-square
  /// with `disagreement_dof` degrees of freedom for a run like the others (fewer than 3 if the run does not
  /// observe all three; 0 if there are no other runs).
  double disagreement = 0;
  int disagreement_dof = 0;
  bool outlier = false;  // probability below one in a thousand among so many runs
  std::vector<SlipEvent> slip_events;
};

/// Innovations while the robot moved in one way.
struct KindFit {
  Motion motion = Motion::line;
  int samples = 0;
  double distance_m = 0, rotation_rad = 0;
  double rms_xy_m = 0, rms_theta_rad = 0;  // of the innovations; theta NaN without headings
  double chi_square_per_dof = 0;
};

/// Whether arcs and spins have the same wheelbase: real tyres turn about another point in a spin.
struct WheelbaseByKind {
  double arc_over_spin = 1, standard_error = 0;
  /// They differ by more than four standard errors and 0.1 %. The error is not widened by `dispersion`,
  /// because runs that differ for this reason would hide it.
  bool disagrees = false;
};

struct MlEstimate {
  WheelFactors factors;
  FactorCovariance covariance = FactorCovariance::Zero();
  MlErrors se;
  LeverArm lever, lever_se;  // yaw NaN where no heading was measured
  double clock_skew = 0,
         clock_skew_se = 0;  // the robot's clock runs (1 + skew) times as fast as the tracker's
  NoiseModel noise;          // K: its upper 95 % limit if the data do not determine it to a third
  /// Time between the truth samples that the likelihood uses, in the longest run, if closer samples have
  /// correlated errors that slip and tracker do not explain (whiteness.hpp); 0 if all samples are used.
  double thinned_to_s = 0;
  int stride = 1;  // the same as a number of samples
  std::vector<RunFit> runs;
  std::vector<Remark> left_out;                      // PreparedRuns::left_out; other useless runs are errors
  std::vector<KindFit> kinds;                        // only those that occur, in the order of Motion
  std::optional<WheelbaseByKind> wheelbase_by_kind;  // only with enough of both
  /// How much more the runs that are no outliers scatter than their noise explains, as a factor on variances.
  /// The covariance and all standard errors of factors include it. 1 if they do not scatter more.
  double dispersion = 1;
  double chi_square = 0;
  int degrees_of_freedom = 0;
  int iterations = 0;

  double E_d() const { return factors.c_r / factors.c_l; }
  double scale() const { return (factors.c_r + factors.c_l) / 2; }
};

/// `loaded` are the factors in the robot. Only b is used, as a scale for what is plausible, and the factors as
/// start values if the truth has no headings.
///
/// Throws astro::Error in one sentence with its remedy for
///   no runs; a run too short, without truth, or whose two streams do not overlap (named)
///   headings of truth that never change although the wheels turn the robot
///   truth that turns the other way: mirrored axes or exchanged wheels
///   runs that never turn, never go straight, or otherwise do not observe one of the three factors
///   factors below half or above twice what is plausible: wrong units or counts
/// Cost    linear in the samples; ten 3 m squares of 60 Hz take about 0.2 s.
MlEstimate estimate_ml(std::span<const Trajectory> runs, const WheelFactors& loaded,
                       const MlOptions& options = {});

/// The smallest covariance of c_R, c_L, b (b in m) that an unbiased estimator can have (Cramer-Rao bound): the
/// inverse of the Fisher information of these runs. `options.noise` must be given. The path comes from the
/// wheels and `factors`; of truth only the times matter, apart from the search for the clocks and the checks
/// of usable runs. As in the estimate, truth samples closer than two samples of the wheels do not count
/// (preparation.hpp): with all of them, a tracker with centimetres of noise over counts at 20 Hz would seem up
/// to 1.6 times as good as it is; at 100 Hz over 60 Hz nothing changes.
///
/// Throws astro::Error as estimate_ml does for runs that cannot be used, and if the runs do not observe one of
/// the three.
FactorCovariance cramer_rao_bound(std::span<const Trajectory> runs, const WheelFactors& factors,
                                  const LeverArm& lever, const MlOptions& options);

/// The standard errors of a covariance.
MlErrors errors_of(const FactorCovariance& covariance, const WheelFactors& factors);

/// Throws astro::Error unless all three factors are known to 5 %: with less, the runs do not tell them apart.
void require_observed(const MlErrors& se, const WheelFactors& factors);

}  // namespace astro::calibration
