#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/simulation/study/drive_source.hpp"
#include "host/simulation/study/setup.hpp"
#include "host/simulation/study/trial.hpp"

/// From trials to the table: the errors that each method leaves, and the bound for every method.
namespace astro::simulation::study {

/// Root mean squares over trials with their Monte Carlo standard errors (delta method: sd(e^2) / (2 rms
/// sqrt(n))), which are NaN for a single answer. The first four figures of the bound are exact, so their
/// standard errors are 0.
struct Row {
  std::string name;
  int trials = 0;
  Errors rms{}, se{};
};

/// A method's rms divided by the bound's, with its standard error from the finite number of trials.
struct Ratio {
  double value = 0, se = 0;
};

/// The mean of a signed error over trials, with its standard error (NaN for a single answer): a bias if it is far from zero.
struct MeanError {
  double value = 0, se = 0;
};

/// Mean of Trial::ml_chi_square over trials: `expected` if the covariance is consistent with the errors, more if it
/// is too small. Expected is the mean number of unknowns, 3 without e and 4 with it.
struct CovarianceConsistency {
  int trials = 0;
  double mean = 0, se = 0, expected = 3;
};

struct Summary {
  TrialSetup setup;
  std::vector<Row> methods;  // those with an answer in any trial, in the order of kMethods
  Row bound;
  /// For E_d, b / S and S, and for e if the robot has one; empty if maximum likelihood gave no answer.
  std::vector<Ratio> ml_over_bound;
  std::vector<MeanError> ml_mean_errors;  // of the same figures; found less true, relative
  std::optional<CovarianceConsistency> ml_covariance;
  std::optional<double> ml_median_K_m;  // nothing if maximum likelihood did not estimate it
  std::vector<std::string> failures;    // a sentence for each method that failed
};

/// Rms and its standard error for each figure. Precondition: `errors` is not empty.
Row row_of(const std::string& name, const std::vector<Errors>& errors);

/// The Cramer-Rao bound of the set-up as `source` drives it; its last three figures come from factors drawn
/// from its covariance. An e of zero counts as known, so that its bound is zero.
Row bound_of(const TrialSetup& setup, const DriveSource& source);

/// `trials` must be in the order of their index, so that results are the same to the last bit.
Summary summarize(const TrialSetup& setup, const DriveSource& source, const std::vector<Trial>& trials);

}  // namespace astro::simulation::study
