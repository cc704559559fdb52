#pragma once

#include <filesystem>
#include <vector>

#include "host/base/remedy.hpp"
#include "host/experiment/import/robot_geometry.hpp"
#include "host/recording/foreign/wheel_track.hpp"

namespace astro::experiment {

/// `given`, and what it lacks of wheel diameter and wheelbase from the robot's description (URDF) that was recorded in the bag beside
/// the wheels: the topic robot_description, in whatever namespace, that has their joints. A remark says what it is.
///
/// Nothing is looked for if nothing is missing, or if `wheels` come from no bag. Throws astro::Error naming the bag if a description
/// has the wheels and not their sizes, and what recording::read_bag throws.
RobotGeometry completed_by_description(RobotGeometry given, const std::filesystem::path& bag,
                                       const recording::WheelTrack& wheels, std::vector<Remark>& remarks);

}  // namespace astro::experiment
