#pragma once

#include <optional>
#include <vector>

#include "host/calibration/judgement/precision.hpp"
#include "host/simulation/study/programme.hpp"

/// The programme that reaches a wanted precision in the least driving time.
namespace astro::simulation::study {

/// Numbers of runs of the kinds in `kinds`, of the sizes in `sizes`, whose standard errors relative to E_d, S
/// and b are all at most `precision`; turning runs come in pairs, one each way round.
///
/// Of all such programmes it takes the least driving time, under the assumption that the information of runs
/// adds up; in fact the information of a run depends a little on the others, through the lever arm and the
/// skew of the clocks. Whether it meets the target is computed from all of its runs together.
///
/// Throws astro::Error as forecast() does, for a target that is not positive, for kinds that leave a factor
/// open, and for a target that takes more than kMostRuns.
///
/// `target_e`: e is to be found as well, with at most this standard error. Then `kinds` have to show it
/// (why_e_is_hidden).
///
/// Cost    some 0.1 s (0.5 s with e) and that of two or three forecasts.
Forecast shortest_programme(const calibration::Precision& precision, const std::vector<Kind>& kinds,
                            const Programme& sizes, std::optional<double> target_e = {});

}  // namespace astro::simulation::study
