#pragma once

#include <filesystem>
#include <string>

#include "host/calibration/motion/wheel_factors.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// The wheels that a robot's own odometry (nav_msgs/msg/Odometry) was computed from, in metres of a nominal
/// wheel: each step between two poses is the arc that wheels of these factors make. A remark says so, and
/// another one if the poses move sideways, which wheels cannot.
///
/// Precondition  `factors` are those that the robot's program used while it drove.
/// Errors        as poses_in_bag (pose_topics.hpp); astro::Error naming the file if there are fewer than two
///               poses.
WheelTrack wheels_of_odometry(const std::filesystem::path& path, const std::string& topic,
                              const calibration::WheelFactors& factors);

}  // namespace astro::importing
