#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/judgement/before_after.hpp"
#include "host/calibration/judgement/path_errors.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// What a cross-validation says of new factors, run by run and altogether.
namespace astro::calibration {

/// One run with the factors in use, and with factors that were found without it.
struct HeldOutRun {
  RunErrors in_use, found;  // by dead reckoning; of end poses alone, path_rms_m is NaN
  WheelFactors without_it;  // what was found without the run
  /// How much more likely the drive is with the factors that were found than with those in use: difference of
  /// -2 log likelihood. The path errors above accumulate all slip since the start. The likelihood weighs the
  /// error that each moment adds, so it distinguishes factors whose paths differ by less than the slip.
  double gain = 0;
  /// The gain to expect if the factors of all runs together are right; 0 if it is not known.
  double claimed = 0;
};

/// Root mean squares over the runs; NaN where nothing was measured.
struct HeldOutErrors {
  double final_m = 0, final_heading_rad = 0, path_m = 0;
};

struct CrossValidation {
  std::vector<HeldOutRun> runs;
  /// What was not judged, each as a clause that says why: runs of which the others do not tell what these show; a difference
  /// too small for so few drives; factors that may be worse on other motions.
  std::vector<Remark> not_judged;
  double claimed_elsewhere = 0;  // the gains to expect of runs that were not judged
  /// unknown if there are fewer than two drives, or if something was not judged and the rest is not clearly worse. `undecided`
  /// says that the drives would have shown an improvement, or that hardly any is to be had.
  Verdict verdict = Verdict::unknown;

  /// The factors found differ from those in use by less than a robot's do from one day to another, so that other drives of
  /// another day need not be better.
  bool within_drift = false;
  /// The same only together with the errors of these drives: more drives may show a difference.
  bool within_errors_and_drift = false;

  /// Runs that are more likely with the new factors.
  int better_on() const;
  HeldOutErrors in_use() const;
  HeldOutErrors found() const;
  /// Whether the factors of all runs differ from those in use by no more than their errors, or than real robots do from day to
  /// day; false if it is not known.
  bool little_to_gain() const;

  /// Sets the verdict.
  void judge();
  /// Takes "better" back if the factors in use may have been right on another day, and "too small for so few drives" if more of
  /// them would show no more than that. The factors in use have an error of their own, which is taken to be like that of these
  /// drives. `change` is from them to those found, in at most four independent quantities that these
  /// drives show; `own` and `another_day` are the covariances of what was found, without and with what changes from day to day.
  void weigh_against_drift(const Eigen::VectorXd& change, const Eigen::MatrixXd& own,
                           const Eigen::MatrixXd& another_day);
  /// For `not_judged`, if a chi-square of what these runs alone show is significant. The values are the names.
  static Remark known_by_these_alone(const std::vector<std::string>& held_out);
  /// For `not_judged`: "without run 1 and run 3, the runs do not separate ...". Its kind is the
  /// error's, its values are those of the error and then the names.
  static Remark without(const std::vector<std::string>& held_out, const Error& error);
};

}  // namespace astro::calibration
