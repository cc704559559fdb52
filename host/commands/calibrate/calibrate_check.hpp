#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

/// `calibrate check`: the odometry errors of calibrations on recorded drives.
void add_calibrate_check(console::Command calibrate);

}  // namespace astro::commands
