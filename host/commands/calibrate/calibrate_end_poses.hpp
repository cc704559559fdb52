#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

/// `calibrate end-poses`: from measured end-pose errors of squares.
void add_calibrate_end_poses(console::Command calibrate);

}  // namespace astro::commands
