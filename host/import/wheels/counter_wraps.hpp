#pragma once

#include <optional>
#include <string>

#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// What is wrong with a wheel's counter. Values: the file, "left" or "right"; for starts_again the counts before and after, and
/// the time in seconds, for begins_again only the file and the time; for range_unknown the least and the greatest number of
/// counts that its range may have; for beyond_range the value and the range, for too_fast only the range.
enum class CounterProblem { starts_again, begins_again, range_unknown, beyond_range, too_fast };

/// Makes counters and angles continuous that start again at the end of their range: counts of 8, 10, 12, 14, 16, 24 or 32 bits,
/// signed or not, or of any other number of counts; and angles in [0, 2 pi) or [-pi, pi). A wheel is taken to wrap if all its
/// values are in such a range and it jumps by more than half of the range at least once; in a range that is not of 16 or 32
/// bits, only if it comes to both ends each time and the sizes of the jumps fit. Such a wheel must move less than half the range
/// between two samples. Adds a remark for each wheel that wraps, and sets track.counter_range if they are counts. Resets to zero
/// are joined (restarts.hpp), also of travel in metres, which has no range.
///
/// `range`  how many different counts there are, if somebody knows.
/// Errors   astro::Error with `name` and the time if a jump is neither a wrap nor motion: if both ways of reading
///          it are more than four times as long and as fast as any other step of this wheel, or if it is half of all that the
///          wheel does and no range is found. Another one if the wheel wraps in a range that cannot be told from the data,
///          leaves `range`, or moves by half of it between two samples.
void unwrap(WheelTrack& track, const std::string& name, std::optional<double> range = {});

}  // namespace astro::importing
