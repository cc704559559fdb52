#pragma once

#include "host/recording/run.hpp"

namespace astro::recording {

/// Calls `take` for every sample, scan, pose with the gyro and slip of a run in order of time; of those at the same time the odometry
/// comes last.
template <class Take>
void for_each_in_order(const Run& run, Take take) {
  auto truth = run.truth.begin();
  auto scan = run.scans.begin();
  auto gyro = run.gyro.begin();
  auto slip = run.slips.begin();
  for (const OdometrySample& sample : run.odometry) {
    while (truth != run.truth.end() && truth->time_us <= sample.time_us) take(*truth++);
    while (scan != run.scans.end() && scan->time_ns <= 1000 * sample.time_us) take(*scan++);
    while (gyro != run.gyro.end() && gyro->time_us <= sample.time_us) take(*gyro++);
    while (slip != run.slips.end() && slip->time_us <= sample.time_us) take(*slip++);
    take(sample);
  }
  while (truth != run.truth.end()) take(*truth++);
  while (scan != run.scans.end()) take(*scan++);
  while (gyro != run.gyro.end()) take(*gyro++);
  while (slip != run.slips.end()) take(*slip++);
}

}  // namespace astro::recording
