#pragma once

#include <string>

#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// Joins what was counted before and after both wheels began again at zero, as where a controller was reset while it drove: in
/// the one interval between, the wheels are taken to move as in those before and after. A first sample of zeros that the next
/// one is far from is left out, because it was logged before the counters were read. Each is a remark.
///
/// A part of unwrap (counter_wraps.hpp), which is called for all travel that is cumulative. Throws astro::Error
/// (CounterProblem::begins_again) if samples are missing where they begin again: how far the wheels went is not known.
void join_restarts(WheelTrack& track, const std::string& name);

}  // namespace astro::importing
