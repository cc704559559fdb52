#pragma once

#include <span>

#include "host/calibration/judgement/held_out_runs.hpp"
#include "host/calibration/likelihood/maximum_likelihood.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/calibration/motion/wheel_factors.hpp"

/// Whether new factors are better than those in use, judged on drives that they have not seen.
///
/// The runs are divided into groups. Factors are estimated from all groups but one, and the drives of that one are
/// dead-reckoned with them and with the factors in use. Factors from poor data fit their own drives well and others badly; the
/// comparison shows that before anybody loads them. What the other drives cannot tell of a group (held_out_factors.hpp) counts
/// neither for nor against the new factors.
namespace astro::calibration {

/// `in_use`: the factors to compare with. `all`: the estimate from all runs; its noise model, spacing of samples and
/// widening are used for each group.
///
/// scale_known: whether the truth's lengths are. If not, the caller gives `in_use` at the scale found, and S is not compared.
///
/// Cost    less than that of the estimate: each run is followed twice more, whatever the number of groups (one for each run,
///         but ten at most).
CrossValidation cross_validate(const FittedDrives& drives, const WheelFactors& in_use, const MlEstimate& all,
                               const MlOptions& options, bool scale_known = true);

/// The same with drives that were not kept: they are prepared and fitted once more.
CrossValidation cross_validate(std::span<const Trajectory> runs, const WheelFactors& in_use,
                               const MlEstimate& all, const MlOptions& options, bool scale_known = true);

}  // namespace astro::calibration
