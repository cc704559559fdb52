#pragma once

#include <filesystem>

#include "host/recording/run.hpp"

namespace astro::recording {

/// Writes a run as a bag (bag/db3_writer.hpp) into `folder`, which must be empty or absent: /odom, /wheel_counts and
/// /truth as in our recordings, and /scan if there are scans; /tf; and, if the run knows the robot's sizes, /joint_states and a latched
/// /robot_description (robot_messages.hpp). Stamps are the robot's clock, the bag's own times UTC counted from
/// RunInfo::started_at, if there is one. Headings are wrapped: a bag has no place for whole turns.
///
/// Errors  astro::Error naming the file, also if a time is not within +-2^31 s.
void export_rosbag(const Run& run, const std::filesystem::path& folder);

}  // namespace astro::recording
