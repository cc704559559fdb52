#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/day_drift.hpp"
#include "host/calibration/likelihood/slip_events.hpp"
#include "host/calibration/likelihood/unknowns.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/calibration/preparation/eccentricity.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Wheel factors by maximum likelihood from whole trajectories.
///
/// Unknown are c_R, c_L, b and e; per session the lever arm of the tracked body and the skew of the
/// clocks; per run its start pose and the offset between the two clocks; and the noise itself. A Kalman filter runs along each
/// drive (innovation.hpp), and Gauss-Newton maximises the likelihood of its innovations, with Huber's weights against outliers.
/// For normal noise that is the maximum-likelihood estimate, and it reaches the Cramer-Rao bound within a few percent. Only e has
/// a prior that counts (PriorOfE), so the estimate is its posterior mean where the runs show little of it.
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
  /// With a given noise model: the wheel path between the truth samples that are used, because closer samples are not
  /// independent (MlEstimate::spacing_m). Without a given noise model it is estimated.
  double spacing_m = 0;
  /// With a given noise model: by how much the variances exceed what it explains (MlEstimate::widening), so that the prior of
  /// e counts as much as in that estimate. estimate_ml finds it itself.
  double widening = 1;
  /// Whether e is estimated. Off: e is 0, for comparison.
  bool with_e = true;
  /// Huber's loss for slips and for truth samples. Off: least squares, for comparison.
  bool robust = true;
};

/// Of c_R, c_L, b and e in this order; b in metres. The row and the column of an e that is held at 0 are zero.
using FactorCovariance = Eigen::Matrix4d;

/// Standard errors of the factors and of the ratios that people use: E_d = c_R / c_L, S = (c_R + c_L) / 2.
struct MlErrors {
  double c_r = 0, c_l = 0, b_m = 0, e = 0;
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
  int session = 0;  // number of the session (sessions.hpp)
  /// How far the factors of this run, without down-weighting of its slips, are from those of all other runs: chi-square with
  /// `disagreement_dof` degrees of freedom for a run like the others (fewer than there are factors if the run does not observe
  /// all; 0 if there are no other runs).
  double disagreement = 0;
  int disagreement_dof = 0;
  bool outlier = false;  // probability below one in a thousand among so many runs
  std::vector<SlipEvent> slip_events;
};

/// The innovations during one kind of motion.
struct KindFit {
  Motion motion = Motion::line;
  int samples = 0;
  double distance_m = 0, rotation_rad = 0;
  double rms_xy_m = 0, rms_theta_rad = 0;  // of the innovations; theta NaN without headings
  double chi_square_per_dof = 0;
};

/// Where the tracked body sat in one session, and how the clocks ran.
struct SessionFit {
  LeverArm lever, lever_se;  // yaw NaN where no heading was measured
  double clock_skew = 0,
         clock_skew_se = 0;  // the robot's clock runs (1 + skew) times as fast as the tracker's
};

struct MlEstimate {
  WheelFactors factors;
  /// The drives' own noise, of which more drives leave less.
  FactorCovariance covariance = FactorCovariance::Zero();
  MlErrors se;
  /// The same and what the robot changes by from one day to another: of the factors found less those of another day.
  FactorCovariance covariance_another_day = FactorCovariance::Zero();
  DayDrift drift;
  std::vector<SessionFit> sessions;  // at least one
  NoiseModel noise;                  // K: its upper 95 % limit if the data do not determine it to a third
  /// The wheel path between the truth samples that the likelihood uses, if closer samples have correlated
  /// errors that slip and tracker do not explain (whiteness.hpp); 0 if all samples are used.
  double spacing_m = 0;
  std::vector<RunFit> runs;
  std::vector<Remark> left_out;  // PreparedRuns::left_out; other useless runs are errors
  std::vector<Remark> mended;    // PreparedRuns::mended
  std::vector<KindFit>
      kinds;               // only those that occur, in the order of Motion; none if only ends were measured
  bool ends_only = false;  // of every run only the poses before and after it (Trajectory::ends_only)
  Eccentricities eccentricities;  // of the wheels; not corrected for
  double dispersion = 1;          // of the runs that are no outliers (agreement.hpp)
  double widening = 1;  // of variances, in all standard errors: the dispersion or more (clustered_dispersion)
  double chi_square = 0;
  int degrees_of_freedom = 0;
  int iterations = 0;

  double E_d() const { return factors.c_r / factors.c_l; }
  double scale() const { return (factors.c_r + factors.c_l) / 2; }
};

/// `loaded` are the factors in the robot. Their b is the scale for what is plausible; if the truth has no headings, the factors
/// are also the start values.
///
/// Throws astro::Error for
///   no runs; a run too short, without truth, or whose two streams do not overlap (named)
///   headings of truth that never change although the wheels turn the robot
///   truth that turns the other way: mirrored axes or exchanged wheels
///   runs that never turn, never go straight, or otherwise do not observe one of the three factors
///   factors below half or above twice what is plausible: wrong units or counts, or stamps that are no times of the samples;
///   a wheelbase of about half or twice the loaded one
/// Cost    linear in the samples; ten 3 m squares of 60 Hz take about 0.2 s.
MlEstimate estimate_ml(std::span<const Trajectory> runs, const WheelFactors& loaded,
                       const MlOptions& options = {});

/// Drives as an estimate prepared and fitted them, so that whoever judges it need not do either again.
struct FittedDrives {
  PreparedRuns prepared;
  std::vector<Unknowns> unknowns;  // of each prepared run
};

struct MlFitted {
  MlEstimate estimate;
  FittedDrives drives;
};

/// estimate_ml, with the drives. `runs` must outlive them.
MlFitted fit_ml(std::span<const Trajectory> runs, const WheelFactors& loaded, const MlOptions& options = {});

/// The smallest covariance of the factors that an unbiased estimator can have (Cramer-Rao bound): the inverse of the Fisher
/// information of these runs. `options.noise` must be given. The path comes from the wheels and `factors`, whose e counts as
/// unknown, with its prior, if it is not zero; of truth only the times matter, apart from the search for the clocks and the checks of usable
/// runs. As in the estimate, truth samples closer than two samples of the wheels do not count (preparation.hpp): with all of
/// them, a tracker with centimetres of noise over counts at 20 Hz would seem up to 1.6 times as good as it is; at 100 Hz over
/// 60 Hz nothing changes.
///
/// Throws astro::Error as estimate_ml does for runs that cannot be used, and if the runs do not observe one of
/// the three.
FactorCovariance cramer_rao_bound(std::span<const Trajectory> runs, const WheelFactors& factors,
                                  const LeverArm& lever, const MlOptions& options);

/// The standard errors of a covariance.
MlErrors errors_of(const FactorCovariance& covariance, const WheelFactors& factors);

/// Throws astro::Error unless all three factors are known to 5 %; otherwise the runs do not separate them.
void require_observed(const MlErrors& se, const WheelFactors& factors);

}  // namespace astro::calibration
