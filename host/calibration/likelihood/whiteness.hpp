#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

/// Whether the innovations of the filter are what the noise model says: independent, over long ways as well as over short ones.
///
/// The model has slip, which accumulates along the path, and a tracker whose samples err independently. Other errors come and go:
/// wheels out of round, tyres that are wound up in a spin and let go at the restart. From sample to sample they look like slip,
/// and so the slip over a long way, of which there is less, comes out smaller than the model says. Errors that persist for a
/// while have the opposite effect.
///
/// Both tests return false only if some mean square differs significantly (one in ten thousand, on either side) and by more than
/// a fifth. With too few innovations they return true. Innovations have variance 1 (standardised_innovations); `fitted` is the number of
/// unknowns fitted to them, which reduces the squares.
///
/// Source  the variance ratio of Lo & MacKinlay 1988, Review of Financial Studies 1(1).
namespace astro::calibration {

/// By sums over neighbouring innovations of each run. If these are independent, the mean square of a sum is the number of its
/// terms; if errors come back it is smaller, if they persist it is larger.
bool are_independent(std::span<const std::vector<Eigen::Vector3d>> runs, int fitted);

/// By the innovations of the same model at wider and wider spacings of the samples, all runs together; first those at the spacing in question,
/// to which the unknowns were fitted. If the model holds over path, their mean square stays what it is. A sum over neighbours does
/// not show this where many of them belong to one stand of the robot.
bool hold_over_path(std::span<const std::vector<Eigen::Vector3d>> spacings, int fitted);

/// Fewer innovations at a spacing than this say nothing.
std::size_t fewest_innovations(int fitted);

}  // namespace astro::calibration
