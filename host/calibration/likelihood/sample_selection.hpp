#pragma once

namespace astro::calibration {

/// Which truth samples of a run the filter uses: `first`, and every `stride`-th after it. The others only say
/// how the robot moved in between.
struct SampleSelection {
  int stride = 1;
  int first = 0;  // less than stride
};

}  // namespace astro::calibration
