#pragma once

#include <cmath>
#include <string>

#include "host/base/error.hpp"
#include "host/base/require_positive.hpp"

/// Limits that set-ups and programmes have to keep.
namespace astro::simulation::study {

/// Drives are held in memory as a whole; 20 million samples of counts and ground truth are about 1 GB.
inline void require_fits_memory(double driving_time_s, double truth_rate_hz, double count_rate_hz) {
  constexpr double kMostSamples = 20e6;
  if (driving_time_s * (truth_rate_hz + count_rate_hz) <= kMostSamples) return;
  throw Error("some " + std::to_string(std::llround(driving_time_s / 3600)) +
              " hours of driving are more than fit into memory: take fewer or shorter runs, or lower rates");
}

}  // namespace astro::simulation::study
