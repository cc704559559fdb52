#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

/// `calibrate bag`: from bags of ROS 2 that hold wheels and ground truth.
void add_calibrate_bag(console::Command calibrate);

}  // namespace astro::commands
