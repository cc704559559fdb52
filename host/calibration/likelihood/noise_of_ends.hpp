#pragma once

#include <span>

#include "host/calibration/likelihood/maximum_likelihood.hpp"

namespace astro::calibration {

/// The noise of drives of which only the ends were measured (Trajectory::ends_only). How exact a person reads a tape and two
/// marks on the chassis is given by `reading`, because one pose at an end does not tell it from slip. The slip is found: its
/// usual value, scaled until the ends differ from the fit as much as they should, with a prior of the weight of four readings,
/// so that two drives that happen to agree do not seem exact.
///
/// Errors  as estimate_ml.
NoiseModel noise_of_ends(std::span<const Trajectory> runs, const WheelFactors& loaded, MlOptions options,
                         const NoiseModel& reading = {.sigma_xy_m = 0.002, .sigma_theta_rad = 0.007});

}  // namespace astro::calibration
