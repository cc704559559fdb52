#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

/// Whether innovations are independent of one another, as the likelihood assumes.
namespace astro::calibration {

/// Real wheels are a little out of round, tyres and gears are elastic, times jitter. So over a second the robot
/// deviates from its wheels by more than slip explains, and comes back. A random walk fitted to such errors has
/// far too much slip and gives too large errors for long drives. Errors that persist for seconds have the
/// opposite effect. Both show in sums over neighbouring innovations: if these are independent, the mean square of
/// a sum is the number of its terms; if errors come back it is smaller, if they persist it is larger.
///
/// `runs`: innovations of each run, of variance 1 (standardised_innovations). `fitted`: the number of unknowns
/// fitted to them, which reduces the sums. Returns false only if some sum differs significantly (one in ten
/// thousand, on either side) and by more than a fifth. With too few innovations it returns true.
///
/// Source  the variance ratio of Lo & MacKinlay 1988, Review of Financial Studies 1(1).
bool are_independent(std::span<const std::vector<Eigen::Vector3d>> runs, int fitted);

}  // namespace astro::calibration
