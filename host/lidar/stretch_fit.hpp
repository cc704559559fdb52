#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "host/lidar/stretch.hpp"

/// The unknowns by robust least squares over stretches whose motion both wheels and scans tell.
namespace astro::lidar {

/// What is known before the drives: means and standard deviations. An unknown with the deviation 0 keeps its mean.
struct Prior {
  Unknowns mean, deviation;
};

/// Of a robot of which nobody knows more than that it is one, about start values; of e about 0. A robot whose wheels are off by more
/// still is calibrated, because the drives outweigh this. late: whether the scans' stamps may be.
Prior wide_prior(const Unknowns& start, bool late);

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
  Information covariance;  // with the spread that the stretches really have; 0 of those that keep their mean
};

/// Each stretch is weighted by the inverse of its match's covariance plus the wheels' scatter, which is that of the residuals
/// themselves; outliers (slip, people) count little. `at`: where the stretches were linearised. Precondition: three stretches at least.
StretchFit fit(std::span<const LinearStretch> stretches, const Unknowns& at, const Prior& prior);

/// With stretches that are linearised anew until nothing changes. Returns where they were linearised last as well.
struct IteratedFit {
  StretchFit fit;
  std::vector<LinearStretch> stretches;
  Unknowns at;
};
IteratedFit iterated_fit(std::span<const Stretch> stretches, const Prior& prior,
                         const calibration::WheelFactors& loaded);

}  // namespace astro::lidar
