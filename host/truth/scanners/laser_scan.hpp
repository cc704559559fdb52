#pragma once

#include <optional>

#include "host/formats/messages/sensors.hpp"
#include "host/lidar/scan.hpp"

namespace astro::truth {

/// The scan in a message of ROS 2, whose ranges it takes. Its time is the message's stamp. Nothing if no scanner can have made it:
/// without such limits a damaged message takes an hour, or has points nowhere.
std::optional<lidar::Scan> scan_in(ros2::msg::LaserScan&& message);

}  // namespace astro::truth
