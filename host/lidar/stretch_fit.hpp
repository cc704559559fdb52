#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "host/lidar/stretch.hpp"

/// The unknowns by robust least squares over stretches whose motion both wheels and scans tell.
namespace astro::lidar {

/// Which unknowns are estimated; the others keep their start values.
using Freedom = std::array<bool, kUnknowns>;

/// How much is known before anything was driven: standard deviations about the start values, and of e about 0. A robot whose wheels
/// are off by more still is calibrated, because the drives outweigh this.
Unknowns prior_deviations();

/// A stretch near some unknowns: what the scans say minus what the wheels say, and how the latter changes with the unknowns.
struct LinearStretch {
  std::size_t index = 0;  // of the stretch
  Eigen::Vector3d residual;
  Eigen::Matrix<double, 3, kUnknowns> jacobian;
  Eigen::Matrix3d covariance;  // of the match
};

/// Those of the stretches whose scans were matched.
std::vector<LinearStretch> linearised(std::span<const Stretch> stretches, const Unknowns& at,
                                      const calibration::WheelFactors& loaded);

struct StretchFit {
  Unknowns unknowns;
  Information covariance;  // of those that are free: with the spread that the stretches really have; others 0
};

/// Each stretch is weighted by the inverse of its match's covariance plus the wheels' scatter, which is that of the residuals
/// themselves; outliers (slip, people) count little. `at`: where the stretches were linearised. `start`: the values of unknowns
/// that are not free, about which the others have their prior (prior_deviations). Precondition: three stretches at least.
StretchFit fit(std::span<const LinearStretch> stretches, const Unknowns& at, const Unknowns& start,
               const Freedom& free);

/// All unknowns that are free, with stretches that are linearised anew until nothing changes. Returns where they were linearised
/// last as well.
struct IteratedFit {
  StretchFit fit;
  std::vector<LinearStretch> stretches;
  Unknowns at;
};
IteratedFit iterated_fit(std::span<const Stretch> stretches, const Unknowns& start, const Freedom& free,
                         const calibration::WheelFactors& loaded);

}  // namespace astro::lidar
