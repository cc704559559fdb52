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

/// From recordings to wheel factors, whatever the method.
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
  std::vector<std::string> session_names = {};  // of each in the estimate; "": it was found from the data
};

struct Calibration {
  /// The factors of the robot's odometry while it drove. If runs of several sets are calibrated together: in the
  /// run that was driven last.
  calibration::WheelFactors loaded;
  calibration::WheelFactors factors;  // what to load; end poses do not show e and keep the loaded one
  FactorErrors se;
  RobotIdentity robot;                // empty if no recording names it
  std::optional<NominalWheel> wheel;  // to which c_R and c_L refer, if a recording names it
  /// End errors of the squares among the runs, if squares of one kind were driven in both directions.
  std::optional<calibration::ExperimentSummary> squares;
  std::variant<calibration::Estimate, MlResult> detail;
  /// Standard error of the common factor of all lengths in the truth, which maximum likelihood does not know: it is part of
  /// the errors of c_R, c_L, b and S. Infinite: nobody measured a length, so S is as loaded, and only E_d and b / S are found.
  double truth_scale_sigma = 0;
  /// The scale from measured lines, in `factors` already; none without lines, and none of maximum likelihood.
  std::optional<calibration::LineScale> line_scale;
  std::vector<std::string> left_out;  // squares that end poses do not use: which, and why
  /// The loaded factors and new ones on drives that the new ones have not seen; unknown for a single drive.
  calibration::CrossValidation judgement;

  const MlResult* ml() const { return std::get_if<MlResult>(&detail); }
  const calibration::Estimate* end_poses() const { return std::get_if<calibration::Estimate>(&detail); }
  /// "ml", "umbmark", "extended", "least-squares", "robust".
  std::string_view method() const;

  /// How the factors differ from the loaded ones: wheel ratio and wheelbase, new over loaded. Of end poses, E_b contains the
  /// change of the scale, because a closed square shows b / S.
  double E_d() const;
  double E_b() const;
  /// (c_R + c_L) / 2. The methods of end poses keep the loaded one unless lines were measured.
  double scale() const { return (factors.c_r + factors.c_l) / 2; }
  double scale_change() const;  // new over loaded
  /// Whether e is worth a word: it is found, or was loaded.
  bool shows_e() const { return factors.e != 0 || loaded.e != 0; }

  /// Whether the factors hold on top of anything that may be loaded in the robot by now: those of maximum likelihood
  /// refer to the nominal wheel, those of end poses are composed with `loaded`.
  bool absolute() const { return ml() != nullptr; }
};

/// Settings of maximum likelihood beyond the runs.
struct MlChoice {
  /// automatic: known if all truth was recorded on the robot's own clock, as in the simulator.
  enum class Clock { automatic, known, estimated };
  Clock clock = Clock::automatic;
  std::optional<calibration::NoiseModel> noise;  // estimated unless given
  std::optional<bool> with_e = {};               // see calibration::MlOptions
};

/// Whether all truth is on the robot's own clock: as `clock` says or, automatic, as the recordings do.
bool clock_known(const RunSet& set, MlChoice::Clock clock);

/// automatic: maximum likelihood where all runs have moving truth; what calibrate(Squares) takes where not.
/// Maximum likelihood takes runs of every kind, the methods of end poses take the squares among them.
///
/// Throws astro::Error: see trajectories_of, calibration::estimate_ml, squares_of and
/// calibration::estimate_factors.
Calibration calibrate(const Recordings& recordings, const MethodChoice& method, const MlChoice& ml = {});

/// After the phases of an experiment, at least one: maximum likelihood takes all runs so far, as its factors
/// do not depend on what was loaded in the robot, so each round adds to the rounds before; the methods of end poses
/// take the squares of the last phase alone, and the lines of all: a scale is absolute. `squares` are those of the last phase. Throws as above.
Calibration calibrate_after(std::span<const std::shared_ptr<const Recordings>> phases,
                            const MethodChoice& method, const MlChoice& ml = {});

/// What the plan of an experiment says about maximum likelihood: squares alone do not show e, so without circles it is not
/// looked for.
MlChoice ml_choice(const Plan& plan);

/// From end poses and measured lines alone; automatic: robust. Throws astro::Error if the method is maximum likelihood,
/// which needs more; and what calibration::estimate_factors and calibration::scale_of_lines throw.
Calibration calibrate(const Squares& squares, const MethodChoice& method);

}  // namespace astro::experiment
