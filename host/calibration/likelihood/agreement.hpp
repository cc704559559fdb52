#pragma once

#include <span>
#include <vector>

#include "host/calibration/likelihood/normal_equations.hpp"

/// Whether each run agrees with all others about the factors, and how much more they scatter than their noise explains.
namespace astro::calibration {

/// d' C^-1 d for the change d of the factors when the run is left out, with its covariance C. It has a
/// chi-square distribution with `degrees_of_freedom` if the run is like the others.
struct Disagreement {
  double chi_square = 0;
  int degrees_of_freedom = 0;  // 0: nothing to compare, or the others alone do not observe a factor
};
/// `truth_is_spaced`: the runs use truth samples that were thinned (MlEstimate::spacing_m).
std::vector<Disagreement> disagreements(std::span<const Reduced> runs, const FixedParameters& fixed,
                                        bool truth_is_spaced = false);

/// All disagreements together: chi-square if the noise explains them. Each run is compared with all others: n comparisons, of which n - 1
/// are independent.
struct Scatter {
  double chi_square = 0;
  int degrees_of_freedom = 0;  // 0: fewer than two runs to compare

  /// Of the variances; 1 if there is nothing to compare.
  double ratio() const;
  /// Whether noise explains it with a probability below 1 %.
  bool significant() const;
};
Scatter scatter(std::span<const Disagreement> runs);

/// Birge's ratio of all runs: how much more they scatter than their noise explains, as a factor on variances;
/// 1 if that is not significant. Source  Birge 1932, Phys. Rev. 40, 207.
double dispersion(std::span<const Disagreement> runs);

/// The same ratio as a median, which a few deviating runs do not change; at least 1.
double typical_dispersion(std::span<const Disagreement> runs);

/// Of each run whether its disagreement has a probability below one in a thousand among so many runs.
std::vector<bool> outliers(std::span<const Disagreement> runs);

/// A run in stretches that follow one another. Runs of equal `course` repeat each other (preparation/courses.hpp) and have equally many.
struct RunInStretches {
  std::vector<Reduced> stretches;
  int course = 0;
  bool outlier = false;  // down-weighted already: it does not count
};

/// How much larger the variances of the factors are than the noise explains, for two kinds of errors that it does not know: those
/// that last for a run, and those that return in each run at the same place of its course. The latter do not show between runs, but neither do
/// they average out over them, and on another course they are others. Unknown errors of both kinds have the variance
///
///   V = V_runs + V_places - V_stretches,
///
/// with sums of squares over runs, over places of the course (the stretches there of all its runs together) and over single stretches,
/// which the first two both contain. Each is taken as its ratio to what the noise explains (Scatter), so the result is a factor as Birge's is.
///
/// At least 1, so that runs that happen to agree claim no more than the noise allows. Unless `truth_is_spaced`, because there are errors
/// that the noise model does not know, it is 1 if neither the scatter of runs nor that of places is significant.
///
/// Source  Cameron, Gelbach & Miller 2011, Journal of Business & Economic Statistics 29(2), eq. 2.11.
double clustered_dispersion(std::span<const RunInStretches> runs, const FixedParameters& fixed,
                            bool truth_is_spaced);

/// Probability that a chi-square variable with `degrees_of_freedom` exceeds `value`; 1 for 0 degrees. Exact up to 3, Wilson and
/// Hilferty's approximation above.
double chi_square_tail(double value, int degrees_of_freedom);

}  // namespace astro::calibration
