#pragma once

#include <optional>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"

namespace astro::calibration {

/// What may spoil a calibration or its judgement. Values: the run (run_stands_out, run_slipped), the runs
/// (known_by_these_alone), how many times the usual slip and, if one run shows most of it, the run (slips_too_much); then for
/// each slip the seconds since the run's start, and the degrees; of clocks_run_apart by how many parts in a million.
enum class JudgementProblem {
  too_few_squares,
  single_line,
  known_by_these_alone,
  too_few_drives,
  uncertain_elsewhere,
  run_stands_out,
  run_slipped,
  runs_differ,
  given_noise_is_wrong,
  estimated_noise_is_wrong,
  clocks_run_apart,
  slips_too_much
};

/// How far the drives show that gentle arcs turn about another wheelbase than spins: below two standard errors of e, below three,
/// or more. An e whose error is not known was given by a person, who knows.
enum class Shown { no, perhaps, clearly };
Shown two_wheelbases(double e, double standard_error);

/// The skew of a session's clocks in parts in a million, if it is certainly beyond `most`.
std::optional<double> skew_beyond(const SessionFit& session, double most);

/// One sentence for each problem of an estimate; empty if there is none. `noise_given`: the noise model was given
/// (MlOptions::noise) and not estimated.
std::vector<Remark> remarks(const MlEstimate& estimate, bool noise_given = false);

}  // namespace astro::calibration
