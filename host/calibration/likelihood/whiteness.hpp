#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

/// Whether the innovations of the filter are what the noise model says: independent, over long paths as well as over short
/// ones.
///
/// The model has slip, which accumulates along the path, and a tracker whose samples err independently. Other errors come and
/// go: wheels are out of round, or tyres wind up in a spin and unwind at the restart. From sample to sample these errors look
/// like slip, but over a long path they cancel, so the slip there comes out smaller than the model says. Errors that persist
/// for a while have the opposite effect.
///
/// Both tests return false only if some mean square differs significantly (one in ten thousand, on either side) and by more
/// than a fifth. With too few innovations they return true. Innovations have variance 1 (standardised_innovations); `fitted` is
/// the number of unknowns fitted to them, which reduces the squares.
///
/// Source  the variance ratio of Lo & MacKinlay 1988, Review of Financial Studies 1(1).
namespace astro::calibration {

/// Tests sums over neighbouring innovations of each run. If these are independent, the mean square of a sum is the number of
/// its terms; if errors come back it is smaller, if they persist it is larger.
bool are_independent(std::span<const std::vector<Eigen::Vector3d>> runs, int fitted);

/// Tests the innovations of the same model at wider and wider spacings of the samples, all runs together. The first entry is
/// the spacing in question, to which the unknowns were fitted. If the model holds over the path, the mean square does not
/// change with the spacing. Sums over neighbours do not show this if many of them belong to one rest of the robot.
bool hold_over_path(std::span<const std::vector<Eigen::Vector3d>> spacings, int fitted);

/// The smallest number of innovations at a spacing that can be tested.
std::size_t fewest_innovations(int fitted);

}  // namespace astro::calibration
