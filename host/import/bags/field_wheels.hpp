#pragma once

#include <filesystem>
#include <optional>

#include "host/import/bags/wheel_sources.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// The wheels in numbers of messages of any type, made continuous or, if they are speeds, integrated. Times
/// are the stamps in the messages, or if most have none, when the recorder received them; that is said. If
/// each wheel has a topic of its own, the values of one are interpolated at the times of the other: of the
/// one that has fewer messages, if they differ by a tenth, and otherwise of the one that begins earlier.
///
/// `counter_range`  how many different counts a counter has, if somebody knows.
/// Precondition  the source is of fields that are in the bag.
/// Errors        astro::Error naming the file if it has fewer than two messages of both wheels, and as
///               unwrap().
WheelTrack wheels_of_fields(const std::filesystem::path& path, const WheelSource& source,
                            const TravelMeasure& measure, std::optional<double> counter_range = {});

}  // namespace astro::importing
