#pragma once

namespace astro::calibration {

/// Whose errors count less where they are beyond the 99 % quantile (huber.hpp).
enum class Doubt { nobody, tracker, tracker_and_wheels };

}  // namespace astro::calibration
