#pragma once

#include <vector>

#include "host/calibration/judgement/precision.hpp"
#include "host/simulation/study/programme.hpp"

/// The programme that reaches a wanted precision in the least driving time.
namespace astro::simulation::study {

/// Numbers of runs of the kinds in `kinds`, of the sizes in `sizes`, whose standard errors relative to E_d, S
/// and b are all at most `target`; turning runs come in pairs, one each way round.
///
/// Of all such programmes it takes the least driving time, under the assumption that the information of runs
/// adds up; in fact the information of a run depends a little on the others, through the lever arm and the
/// skew of the clocks. Whether it meets the target is computed from all of its runs together.
///
/// Throws astro::Error as forecast() does, for a target that is not positive, for kinds that leave a factor
/// open, and for a target that takes more than kMostRuns.
///
/// Cost    some 0.1 s and that of two or three forecasts.
Forecast shortest_programme(const calibration::Precision& target, const std::vector<Kind>& kinds,
                            const Programme& sizes);

}  // namespace astro::simulation::study
