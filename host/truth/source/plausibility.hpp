#pragma once

#include <string>

#include "host/recording/run.hpp"

namespace astro::truth {

/// Why a measured end can hardly be that of this run: a clause with the distance (or angle) between it and the end by
/// odometry, the length of the run, and what would fit with another decimal point, unit or sign; "" if it is plausible.
/// Odometry that is wrong by more than a quarter of the distance driven (and 0.2 m) or by more than 60 degrees is rarer than
/// a wrong unit or a typing error: Borenstein & Feng's worst robot was wrong by 3 % of the distance. Start and end are in any
/// common frame. If the end has no heading, only its position is checked.
std::string implausible_end(const recording::Run& run, const recording::TruthSample& start,
                            const recording::TruthSample& end);

}  // namespace astro::truth
