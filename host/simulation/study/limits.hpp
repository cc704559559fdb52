#pragma once

#include <cmath>
#include <string>

#include "host/base/error.hpp"
#include "host/base/require_positive.hpp"

/// Limits that set-ups and programmes have to keep.
namespace astro::simulation::study {

/// What a set-up or a programme exceeds. Values: for out_of_range the quantity and its value; for
/// exceeds_memory the hours of driving.
enum class LimitProblem { out_of_range, exceeds_memory };

/// Drives are held in memory as a whole; 20 million samples of counts and ground truth are about 1 GB.
inline void require_fits_memory(double driving_time_s, double truth_rate_hz, double count_rate_hz) {
  constexpr double kMostSamples = 20e6;
  if (driving_time_s * (truth_rate_hz + count_rate_hz) <= kMostSamples) return;
  const std::string hours = std::to_string(std::llround(driving_time_s / 3600));
  throw Error(
      "some " + hours +
          " hours of driving are more than fit into memory: take fewer or shorter runs, or lower rates",
      LimitProblem::exceeds_memory, {hours});
}

}  // namespace astro::simulation::study
