#pragma once

#include "host/calibration/likelihood/ml_fit.hpp"
#include "host/calibration/preparation/preparation.hpp"

/// Drives between which somebody mounted the tracked body anew, as the fit of all of them shows.
namespace astro::calibration {

/// Splits sessions that were not named (preparation/sessions.hpp) where the runs have far less in common than two or more places
/// of the body explain, at least a centimetre or 20 mrad apart. A drive alone shows where its body sits only if it has headings
/// and both lines and turns; together with the factors of all drives also circles and positions without headings show it.
/// `fit` is a fit of `runs`. Returns whether `runs` have other sessions now, so that they must be fitted again.
///
/// Method  The fit's information is quadratic in the unknowns, so the gain in -2 log likelihood is known for every way to group
///         the runs, without another fit.
/// Cost    a step of the fit for each run. If there is something to split, the search is quadratic in the runs.
bool split_sessions(const MlFit& fit, PreparedRuns& runs);

}  // namespace astro::calibration
