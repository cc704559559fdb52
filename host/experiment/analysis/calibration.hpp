#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host/calibration/end_poses/line_scale.hpp"
#include "host/calibration/end_poses/umbmark.hpp"
#include "host/calibration/judgement/cross_validation.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/motion/wheel_factors.hpp"
#include "host/experiment/analysis/recordings.hpp"
#include "host/experiment/analysis/squares.hpp"
#include "host/experiment/analysis/trajectories.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/experiment/files/robot_identity.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/lidar/scan_calibration.hpp"

/// Calibrates wheel factors from recordings, with any of the methods.
namespace astro::experiment {

/// Standard errors; NaN if the method or the data do not determine them. E_d, E_b and scale are ratios. That of e is
/// known only where e was estimated.
struct FactorErrors {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double c_r = kUnknown, c_l = kUnknown, b_m = kUnknown;
  double E_d = kUnknown, E_b = kUnknown, scale = kUnknown;
  double e = kUnknown;
};

/// The result of maximum likelihood with its options.
struct MlResult {
  calibration::MlOptions options;
  calibration::MlEstimate estimate;
  bool noise_given = false;                     // by a person
  std::vector<std::string> session_names = {};  // of each in the estimate; "" if it was found from the data
};

struct Calibration {
  /// The factors of the robot's odometry while it drove. If runs with several sets are calibrated together, they are those
  /// of the run that was driven last.
  calibration::WheelFactors loaded;
  calibration::WheelFactors factors;  // what to load; end poses do not show e and keep the loaded one
  FactorErrors se;                    // the drives' own: more drives make them smaller
  /// On another day: these and what robots change by from one day to another, which is estimated from several sessions or taken
  /// from other robots.
  FactorErrors se_another_day;
  calibration::DayDrift drift;
  /// Of c_R, c_L, b and e on another day; none where closed squares leave S as loaded.
  std::optional<calibration::FactorCovariance> covariance_another_day;
  RobotIdentity robot;                // empty if no recording names it
  std::optional<NominalWheel> wheel;  // to which c_R and c_L refer, if a recording names it
  /// End errors of the squares among the runs, if squares of one kind were driven in both directions.
  std::optional<calibration::ExperimentSummary> squares;
  std::variant<calibration::Estimate, MlResult, lidar::ScanCalibration> detail;
  /// Relative standard error of the scale of the ground truth, which neither maximum likelihood nor scans can show. It is part of the
  /// errors of c_R, c_L, b and S. It is infinite if nobody measured a length; then S stays as loaded, and only E_d and b / S
  /// are found.
  double truth_scale_sigma = 0;
  /// Relative standard error of the loaded S, which then counts beside that of the scans; infinite if nobody has stated it.
  double loaded_scale_sigma = std::numeric_limits<double>::infinity();
  double loaded_scale_apart = 0;  // then: what both differed by, in standard errors of the difference
  /// The scale from measured lines, which `factors` already contain; none without lines, and none by maximum likelihood.
  std::optional<calibration::LineScale> line_scale;
  std::vector<std::string> left_out;  // squares that end poses do not use: which, and why
  std::optional<Remark> misfit;       // of end poses: no wheels explain them (misfit.hpp)
  /// Compares the loaded and the new factors on hold-out drives; the verdict is unknown for a single drive.
  calibration::CrossValidation judgement;

  const MlResult* ml() const { return std::get_if<MlResult>(&detail); }
  const calibration::Estimate* end_poses() const { return std::get_if<calibration::Estimate>(&detail); }
  const lidar::ScanCalibration* scans() const { return std::get_if<lidar::ScanCalibration>(&detail); }
  /// "ml", "scan", "umbmark", "extended", "least-squares", "robust".
  std::string_view method() const;

  /// How the factors differ from the loaded ones: wheel ratio and wheelbase, new over loaded. By end poses, E_b contains the
  /// change of the scale, because a closed square determines only b / S.
  double E_d() const;
  double E_b() const;
  /// (c_R + c_L) / 2. The methods of end poses keep the loaded one unless lines were measured.
  double scale() const { return (factors.c_r + factors.c_l) / 2; }
  double scale_change() const;  // new over loaded
  /// Whether e is to be reported, because it was found or an e was loaded.
  bool shows_e() const { return factors.e != 0 || loaded.e != 0; }

  /// Whether the factors are right whatever is loaded in the robot by now. Those of maximum likelihood and of scans are, because
  /// they refer to the nominal wheel; those of end poses are not, because they are composed with `loaded`.
  bool absolute() const { return end_poses() == nullptr; }
};

/// Settings of maximum likelihood beyond the runs.
struct MlChoice {
  /// automatic: known if all truth was recorded on the robot's own clock, as in the simulator.
  enum class Clock { automatic, known, estimated };
  Clock clock = Clock::automatic;
  std::optional<calibration::NoiseModel> noise;  // estimated unless given
};

/// Whether all truth is on the robot's own clock: as `clock` says or, if that is automatic, as the recordings say.
bool clock_known(const RunSet& set, MlChoice::Clock clock);

/// automatic: by scans if all runs have scans of a laser scanner, refused if only some have, by maximum likelihood if all have moving truth, otherwise by the
/// method of calibrate(Squares). The first two take runs of every kind, the methods of end poses take the squares and lines among
/// them.
///
/// Throws astro::Error: see trajectories_of, calibration::estimate_ml, lidar::calibrate_by_scans, squares_of and
/// calibration::estimate_factors.
Calibration calibrate(const Recordings& recordings, const MethodChoice& method, const MlChoice& ml = {});

/// The same after the phases of an experiment. Maximum likelihood takes all runs so far, because its factors do not depend
/// on what was loaded in the robot. The methods of end poses take the squares of the last phase only, and the lines of all
/// phases, because a scale is absolute. Calibration::squares are those of the last phase. Precondition: at least one phase.
/// Throws as above.
Calibration calibrate_after(std::span<const std::shared_ptr<const Recordings>> phases,
                            const MethodChoice& method, const MlChoice& ml = {});

/// From end poses and measured lines alone; automatic: robust. Throws astro::Error if the method is maximum likelihood,
/// which needs more; and what calibration::estimate_factors and calibration::scale_of_lines throw.
Calibration calibrate(const Squares& squares, const MethodChoice& method);

/// Weighs the S that was found with the loaded one, whose relative standard error is `sigma`, by information: a scanner whose ranges
/// are known to a per cent does not replace what a tape or a tracker knows better. The verdict stays, because it is about drives seen
/// by that scanner. Precondition: found by scans, and loaded_scale_sigma is not stated yet.
void weigh_loaded_scale(double sigma, Calibration& found);

/// What scans say, as a calibration, with the standard error of the common scale of the scanner's ranges in the errors of c_R, c_L, b
/// and S. Robot, wheel and squares are not known here.
Calibration calibration_of(lidar::ScanCalibration found, double range_scale_sigma = lidar::kRangeScaleSigma);

}  // namespace astro::experiment
