#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// Rows that are missing in a log of travel per interval.
struct LostRows {
  int steps = 0;              // in which rows are missing
  std::int64_t first_ns = 0;  // end of the first of them
  double part = 0;            // of the whole travel, missing with them
};

/// Detects lost rows in a log of travel per interval, whose rows come at even intervals. After a longer step
/// the row holds the travel of the whole step if the logger was late, but no more than any other row if rows
/// in between were lost. Nothing if the rows are not even, or if the robot stood still in all longer steps.
std::optional<LostRows> find_lost_rows(std::span<const WheelSample> sums);

}  // namespace astro::importing
