#pragma once

#include <optional>
#include <span>

#include "host/calibration/end_poses/end_pose.hpp"

/// Whether a calibration helped, by how much, and how certain that is: statistics of the drives before and
/// after it.
namespace astro::calibration {

/// A quantity of which smaller is better, from `runs` runs. standard_error is NaN where unknown.
struct FigureOfMerit {
  double value = 0;
  double standard_error = 0;
  int runs = 0;
};

/// E_max_syst of an experiment in millimetres, with the runs of the direction that is the maximum.
FigureOfMerit E_max_syst_mm(const ExperimentSummary& squares);

/// Root mean square of one component over the runs of one direction, with its standard error by the delta
/// method.
FigureOfMerit root_mean_square(std::span<const double> values);

/// How many times smaller `after` is than `before`.
struct Improvement {
  double factor = 0;          // before / after; infinite where after is exactly 0
  double standard_error = 0;  // to first order; NaN where unknown
  double low = 0, high = 0;   // 95 % interval; high is infinite where `after` may be 0
};

/// Source  Fieller's theorem for a ratio of independent normal estimates, with Student's t for the smaller of
///         the two numbers of runs less one: no symmetric error describes a ratio of few noisy runs.
Improvement improvement(const FigureOfMerit& before, const FigureOfMerit& after);

enum class Verdict { better, worse, undecided, unknown };

/// better or worse where the difference is significant at the 5 % level, two-sided; unknown without standard
/// errors.
Verdict judge(const FigureOfMerit& before, const FigureOfMerit& after);

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

/// The smallest number of runs before and after with which the same difference would be significant, if each run scattered as
/// these did; nothing if more than 100 would be needed, or without standard errors.
std::optional<int> runs_to_tell(const FigureOfMerit& before, const FigureOfMerit& after);

}  // namespace astro::calibration
