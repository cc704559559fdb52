#pragma once

#include <span>
#include <string>

#include "host/calibration/end_poses/umbmark.hpp"

/// Did the calibration help, by how much, and how sure is that?
namespace astro::report {

/// A figure of merit (smaller is better) from `runs` runs; standard_error is NaN where unknown.
struct Estimate {
  double value = 0;
  double standard_error = 0;
  int runs = 0;
};

/// E_max_syst of an experiment in millimetres, from the runs of the direction that it is of.
Estimate E_max_syst_mm(const calibration::ExperimentSummary& squares);

/// How many times smaller `after` is than `before`.
struct Improvement {
  double factor = 0;          // before / after; infinite where after is exactly 0
  double standard_error = 0;  // to first order; NaN where unknown
  double low = 0, high = 0;   // 95 % interval; high is infinite where `after` cannot be told from 0
};

/// Source  Fieller's theorem for a ratio of independent normal estimates, with Student's t for the smaller of
///         the two numbers of runs less one: a ratio of few noisy runs has no honest symmetric error.
Improvement improvement(const Estimate& before, const Estimate& after);

enum class Verdict { better, worse, undecided, unknown };

/// better or worse where the difference is significant at the 5 % level, two-sided; unknown without errors.
Verdict judge(const Estimate& before, const Estimate& after);

/// One plain sentence about the two estimates, values in millimetres.
std::string verdict_sentence(const Estimate& before, const Estimate& after);

/// What may be said without the figures beside it: "4.5 times smaller"; "at least 2.8 times smaller" where
/// there is no upper bound; "not certainly changed" where the interval holds 1.
std::string claim(const Improvement& improvement);

/// "4.5 ± 0.7 (95 %: 3.2 to 6.9)"; "82 (95 %: at least 10)" where there is no upper bound, for then the
/// first-order error means nothing; "4.5" where nothing is known.
std::string describe(const Improvement& improvement);

/// Two-sided 5 % quantile of Student's t; infinite for less than one degree of freedom.
double student_t_975(int degrees_of_freedom);

/// Root mean square of one component over the runs of one direction, with its standard error by the delta
/// method.
Estimate root_mean_square(std::span<const double> values);

}  // namespace astro::report
