#pragma once

#include <vector>

#include "host/calibration/judgement/precision.hpp"
#include "host/simulation/study/programme.hpp"

/// The programme that takes the least driving time to a wanted precision.
namespace astro::simulation::study {

/// Numbers of runs of the kinds in `kinds`, of the sizes in `sizes`, whose standard errors relative to E_d, S
/// and b are all at most `target`; turning runs come in pairs, one each way round.
///
/// Of all such programmes it is the one of least driving time, as far as the information of runs adds up:
/// what a run tells depends a little on the others, through the lever arm and the skew of the clocks. That it
/// meets the target is computed from all of its runs together.
///
/// Throws astro::Error as forecast() does, for a target that is not positive, for kinds that leave a factor
/// open, and for a target that takes more than kMostRuns.
///
/// Cost    some 0.1 s and that of two or three forecasts.
Forecast shortest_programme(const calibration::Precision& target, const std::vector<Kind>& kinds,
                            const Programme& sizes);

}  // namespace astro::simulation::study
