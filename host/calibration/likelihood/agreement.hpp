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

/// The sum of all disagreements, chi-square distributed if the noise explains them. Each run is compared with all others, which
/// gives n comparisons, n - 1 of them independent.
struct Scatter {
  double chi_square = 0;
  int degrees_of_freedom = 0;  // 0: fewer than two runs to compare

  /// The ratio of the variances; 1 if there is nothing to compare.
  double ratio() const;
  /// Whether noise alone gives so large a scatter with a probability below 1 %.
  bool significant() const;
};
Scatter scatter(std::span<const Disagreement> runs);

/// Birge's ratio of all runs: how much more they scatter than their noise explains, as a factor on variances;
/// 1 if that is not significant. Source  Birge 1932, Phys. Rev. 40, 207.
double dispersion(std::span<const Disagreement> runs);

/// The same ratio as a median, which a few deviating runs do not change; at least 1.
double typical_dispersion(std::span<const Disagreement> runs);

/// For each run whether its disagreement, over the typical dispersion, has a probability below one in a
/// thousand among so many runs.
std::vector<bool> outliers(std::span<const Disagreement> runs);

/// A run as consecutive stretches. Runs of equal `course` repeat each other (preparation/courses.hpp) and have equally many
/// stretches.
struct RunInStretches {
  std::vector<Reduced> stretches;
  int course = 0;
  bool outlier = false;  // down-weighted already: it does not count
};

/// The factor by which the variances of the factors exceed what the noise explains, because of two kinds of errors that the
/// noise model does not contain: errors that last for a whole run, and errors that return in each run at the same place of its
/// course. The latter make no difference between runs, but they do not average out over the runs either, and another course has
/// other ones. With both kinds the variance is
///
///   V = V_runs + V_places - V_stretches,
///
/// with sums of squares over runs, over places of the course (the stretches of all its runs at a place taken together) and over
/// single stretches, which the first two both contain. Each is taken as its ratio to what the noise explains (Scatter), so the
/// result is a factor on variances like Birge's.
///
/// The result is at least 1, so that runs that happen to agree claim no more precision than the noise allows. It is 1 if
/// neither the scatter of runs nor that of places is significant, unless `truth_is_spaced`, which shows that there are errors
/// outside the noise model.
///
/// Source  Cameron, Gelbach & Miller 2011, Journal of Business & Economic Statistics 29(2), eq. 2.11.
double clustered_dispersion(std::span<const RunInStretches> runs, const FixedParameters& fixed,
                            bool truth_is_spaced, const PriorOfE& prior = {});

/// Probability that a chi-square variable with `degrees_of_freedom` exceeds `value`; 1 for 0 degrees. Exact up to 3, Wilson and
/// Hilferty's approximation above.
double chi_square_tail(double value, int degrees_of_freedom);

}  // namespace astro::calibration
