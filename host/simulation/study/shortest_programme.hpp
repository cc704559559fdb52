#pragma once

#include <optional>
#include <vector>

#include "host/calibration/judgement/precision.hpp"
#include "host/simulation/study/programme.hpp"

/// Finds the programme that reaches a wanted precision in the least driving time.
namespace astro::simulation::study {

/// Finds numbers of runs, of the kinds in `kinds` and the sizes in `sizes`, for which the relative standard
/// errors of E_d, S and b are all at most `precision`. Turning runs come in pairs, one in each direction.
///
/// Of all such programmes it takes the one with the least driving time, assuming that the information of runs
/// adds up. In fact the information of a run depends a little on the others, through the lever arm and the
/// clock skew. Therefore all runs together are used to compute whether the programme meets the target.
///
/// Throws astro::Error as forecast() does, for a target that is not positive, for kinds that leave a factor
/// undetermined, and for a target that takes more than kMostRuns.
///
/// `target_e`: e is estimated as well, with at most this standard error. Then `kinds` have to show it
/// (why_e_is_hidden).
///
/// Cost    some 0.1 s (0.5 s with e) and that of two or three forecasts.
Forecast shortest_programme(const calibration::Precision& precision, const std::vector<Kind>& kinds,
                            const Programme& sizes, std::optional<double> target_e = {});

}  // namespace astro::simulation::study
