#pragma once

#include <string>

#include "host/recording/run/run.hpp"

namespace astro::truth {

/// Why a measured end is hardly that of this run: a clause with the distance (or angle) between it and the
/// end that odometry tells and with the length of the run, or "". Odometry that is off by more than a quarter
/// of the way (and 0.2 m) or by more than 60 degrees is rarer than a wrong unit or a slip of the finger:
/// Borenstein & Feng's worst robot was off by 3 % of the way. Start and end are in any frame in common; an
/// end without heading is judged by its place.
std::string implausible_end(const recording::Run& run, const recording::TruthSample& start,
                            const recording::TruthSample& end);

}  // namespace astro::truth
