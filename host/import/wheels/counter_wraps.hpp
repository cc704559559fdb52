#pragma once

#include <string>

#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// What is wrong with a wheel's counter. Values: the file, "left" or "right", the counts before and after,
/// and the time in seconds.
enum class CounterProblem { starts_again };

/// Makes counters and angles continuous that start again at the end of their range: counts of 16 or 32 bits,
/// signed or not, and angles in [0, 2 pi) or [-pi, pi). A wheel is taken to wrap if all its values are in
/// such a range and it jumps by more than half of the range at least once. Such a wheel must move less than
/// half the range between two samples. Adds a remark for each wheel that wraps. Metres are left as they are.
///
/// Errors  astro::Error with `name` and the time if a jump is neither a wrap nor motion: both ways of reading
///         it are more than four times as long and as fast as any other step of this wheel. The counter was
///         restarted then.
void unwrap(WheelTrack& track, const std::string& name);

}  // namespace astro::importing
