#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

/// Whether innovations are independent of one another, as the likelihood takes for granted.
namespace astro::calibration {

/// Real wheels are a little out of round, tyres and gears give and come back, times jitter: over a second the
/// robot strays from what its wheels tell by more than slip would explain, and returns. A random walk fitted
/// to that has far too much slip in it, and claims too large errors for long drives; a robot that slips on
/// for seconds is taken for too good. Either shows in sums over neighbours: of independent innovations they
/// have a mean square equal to their number, of errors that come back less, of errors that go on more.
///
/// `runs`: innovations of each run, of variance 1 (standard_innovations). `fitted`: how many unknowns were
/// fitted to them, which takes as much from the sums. Tells false only if some sum is significantly (one
/// in ten thousand, on either side) and by more than a fifth away; of too few innovations nothing can be
/// told, and it is true.
///
/// Source  the variance ratio of Lo & MacKinlay 1988, Review of Financial Studies 1(1).
bool are_independent(std::span<const std::vector<Eigen::Vector3d>> runs, int fitted);

}  // namespace astro::calibration
