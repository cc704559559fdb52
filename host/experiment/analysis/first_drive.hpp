#pragma once

#include <optional>
#include <string>

#include "host/base/error.hpp"
#include "host/recording/run.hpp"

namespace astro::experiment {

/// What one drive says against the robot, before others are driven in vain: wheels that are exchanged or reversed, wrong counts
/// or diameters, a wheelbase of half or twice the loaded one. The kinds are those of calibration::estimate_ml. Nothing if it
/// says nothing of the sort, or if nothing followed the robot.
std::optional<Remark> why_wrong_robot(const recording::Run& run, const std::string& name);

}  // namespace astro::experiment
