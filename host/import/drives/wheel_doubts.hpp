#pragma once

#include <string>

#include "host/recording/run.hpp"
#include "host/truth/floor/floor_path.hpp"

/// Faults of wiring and of logs that a fit would hide or blame on something else.
namespace astro::importing {

/// A file whose times have no unit of their own; the unit is "" if they have.
struct AssumedTimeUnit {
  std::string file, unit;
};

/// Throws astro::Error if the ground truth of a drive moved and
///   a wheel, or both, never turned;
///   both wheels did exactly the same although the robot turned, wherever in the truth their recording lies;
///   the wheels hardly moved, but would have gone the way of the truth if each sample were the travel since the one before.
void require_turning_wheels(const std::string& name, const recording::Run& run,
                            const truth::FloorFindings& floor);

/// Throws astro::Error if a unit of time that was assumed, in the wheels' file or in that of the truth, makes the drive several
/// times as long as it is by the other file, or many times if the truth has the longer way.
void require_times_alike(const recording::Run& run, const truth::FloorFindings& floor,
                         const AssumedTimeUnit& wheels, const AssumedTimeUnit& truth);

/// Whether by its wheels a robot drove backward, which hardly any does for long.
bool drove_backward(const recording::Run& run);

}  // namespace astro::importing
