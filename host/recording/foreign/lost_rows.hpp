#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "host/recording/foreign/wheel_track.hpp"

namespace astro::recording {

struct LostRows {
  int steps = 0;              // in which rows are missing
  std::int64_t first_ns = 0;  // end of the first of them
  double part = 0;            // of the whole travel that is missing with them
};

/// Rows that a log of travel per interval has lost. Its rows come evenly; after a longer step the row holds the travel of
/// that step if the logger was late, but no more than any other row if those between are lost. Nothing for a log that is not
/// even, or where the robot stood in all longer steps.
std::optional<LostRows> find_lost_rows(std::span<const WheelSample> sums);

}  // namespace astro::recording
