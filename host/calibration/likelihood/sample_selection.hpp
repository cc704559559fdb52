#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace astro::calibration {

/// In wheelbases of the wheels' path: enough samples for a first guess at everything but the noise.
inline constexpr double kRoughSpacing = 0.25;

/// Which truth samples of a run the filter uses. The others only say how the robot moved in between.
///
/// They are chosen by path, not by time: while a robot stands, its tyres hold what they were wound up by, and let go of it at
/// the restart within hardly any travel. Samples of the stand would pin the pose in between, and what is let go would pass
/// for slip.
struct SampleSelection {
  double spacing_m = 0;  // of the wheels' path (PreparedRun::path_m); 0: all samples
  double first_m = 0;    // less than the spacing; 0 takes the first sample

  /// The first sample behind each knot at first_m, first_m + spacing_m, first_m + 2 spacing_m ... of the path.
  bool takes(std::span<const double> path_m, std::size_t sample) const {
    if (spacing_m <= 0) return true;
    if (sample == 0) return first_m <= 0;
    const auto knot = [&](std::size_t i) { return std::floor((path_m[i] - first_m) / spacing_m); };
    return knot(sample) > knot(sample - 1);
  }
};

/// The widest spacing for a run whose wheels go this far: some twenty samples. A short run is thinned less than others.
inline double widest_spacing_m(double path_m) { return path_m / 20; }

/// Of a run, beginning at a part of the spacing.
inline SampleSelection selection_of(std::span<const double> path_m, double spacing_m, double begin = 0) {
  const double of_run_m = std::min(spacing_m, widest_spacing_m(path_m.back()));
  return {of_run_m, begin * of_run_m};
}

}  // namespace astro::calibration
