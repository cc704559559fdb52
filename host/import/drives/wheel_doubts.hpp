#pragma once

#include <string>

#include "host/recording/run.hpp"
#include "host/truth/floor/floor_path.hpp"

/// Faults of wiring and of logs that a fit would hide or blame on something else.
namespace astro::importing {

/// Throws astro::Error if the ground truth of a drive moved and
///   a wheel, or both, never turned;
///   both wheels did exactly the same although the robot turned;
///   the wheels hardly moved, but would have gone the way of the truth if each sample were the travel since the one before.
void require_turning_wheels(const std::string& name, const recording::Run& run,
                            const truth::FloorFindings& floor);

/// The way forward minus that backward by the wheels, over both: -1 for a robot that only drove backward.
double forward_share(const recording::Run& run);

}  // namespace astro::importing
