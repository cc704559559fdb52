#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/judgement/before_after.hpp"
#include "host/calibration/judgement/path_errors.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// Whether new factors are better than those in use, judged on drives that they have not seen.
///
/// The runs are divided into groups. Factors are estimated from all groups but one, and the drives of that one are
/// dead-reckoned with them and with the factors in use. Factors from poor data fit their own drives well and others badly; the
/// comparison shows that before anybody loads them.
namespace astro::calibration {

/// One run with the factors in use, and with factors that were found without it.
struct HeldOutRun {
  RunErrors in_use, found;  // by dead reckoning; of end poses alone, path_rms_m is NaN
  WheelFactors without_it;  // what was found without the run
  /// How much more likely the drive is with the factors that were found than with those in use: difference of
  /// -2 log likelihood. The path errors above accumulate all slip since the start. The likelihood weighs the
  /// error that each moment adds, so it distinguishes factors whose paths differ by less than the slip.
  double gain = 0;
};

/// Root mean squares over the runs; NaN where nothing was measured.
struct HeldOutErrors {
  double final_m = 0, final_heading_rad = 0, path_m = 0;
};

struct CrossValidation {
  std::vector<HeldOutRun> runs;
  /// Runs that could not be held out because the others do not determine all factors; each as a clause that says why.
  std::vector<Remark> not_judged;
  /// unknown if there are fewer than two drives, or if the factors are better but some drives could not be
  /// held out.
  Verdict verdict = Verdict::unknown;

  /// Runs that are more likely with the new factors.
  int better_on() const;
  HeldOutErrors in_use() const;
  HeldOutErrors found() const;

  /// Sets the verdict.
  void judge();
  /// For `not_judged`: "without run 1 and run 3, the runs do not separate ...". Its kind is the
  /// error's, its values are those of the error and then the names.
  static Remark without(const std::vector<std::string>& held_out, const Error& error);
};

/// `in_use`: the factors to compare with. `all`: the estimate from all runs; its noise model, spacing of samples and
/// widening are used for each group.
///
/// Cost    less than that of the estimate: each run is followed twice more, whatever the number of groups (one for each run,
///         but ten at most).
CrossValidation cross_validate(std::span<const Trajectory> runs, const WheelFactors& in_use,
                               const MlEstimate& all, const MlOptions& options);

/// better or worse if the mean gain differs from zero at the 10 % level, one-sided; unknown for fewer than two. If the factors
/// in use are right, factors found from data lose a little on average, so a false claim is far less likely than 10 %: in
/// simulations below 1.5 % for any number of drives.
///
/// For normal noise the variance of a gain is four times its mean. This is the prior for the variance of the gains, with the
/// weight of four drives. Without the prior two drives could hardly show anything, however large the gain, because Student's t
/// would need gains that are equal within a sixth of their mean. With the prior alone the verdict would be too bold for a robot
/// whose slip is not normal.
///
/// Source  Smyth 2004, moderated t statistic.
Verdict judge_gains(std::span<const double> gains);

}  // namespace astro::calibration
