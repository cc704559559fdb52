#pragma once

namespace astro::calibration {

/// Whose errors Huber's loss down-weights where they are beyond the 99 % quantile (huber.hpp).
enum class RobustMode { none, tracker, tracker_and_wheels };

}  // namespace astro::calibration
