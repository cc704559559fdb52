#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace astro::calibration {

/// The spacing, in wheelbases of the wheels' path, that leaves enough samples for start values of everything
/// but the noise.
inline constexpr double kRoughSpacing = 0.25;

/// Selects the truth samples of a run that the filter uses. Of the others only their times and the kind of
/// motion before them are used.
///
/// They are chosen by path, not by time. While a robot stands, its tyres stay wound up, and they unwind at the restart within
/// hardly any travel. Samples at rest would fix the pose in between, and the unwinding would be taken for slip.
struct SampleSelection {
  double spacing_m = 0;  // of the wheels' path (PreparedRun::knots_m); 0: all samples
  double first_m = 0;    // less than the spacing; 0 takes the first sample

  /// True for the first sample at or behind each knot, where the knots are at first_m, first_m + spacing_m, first_m + 2
  /// spacing_m, and so on.
  bool takes(std::span<const double> path_m, std::size_t sample) const {
    if (spacing_m <= 0) return true;
    if (sample == 0) return first_m <= 0;
    const auto knot = [&](std::size_t i) { return std::floor((path_m[i] - first_m) / spacing_m); };
    return knot(sample) > knot(sample - 1);
  }
};

/// The widest spacing for a run whose wheels go this far: some twenty samples. A short run is thinned less than others.
inline double widest_spacing_m(double path_m) { return path_m / 20; }

/// The selection for a run. `begin`: the first knot, as a part of the spacing.
inline SampleSelection selection_of(std::span<const double> path_m, double spacing_m, double begin = 0) {
  const double of_run_m = std::min(spacing_m, widest_spacing_m(path_m.back()));
  return {of_run_m, begin * of_run_m};
}

}  // namespace astro::calibration
