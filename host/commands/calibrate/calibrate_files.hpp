#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

/// `calibrate files`: from wheels and ground truth that other programs recorded.
void add_calibrate_files(console::Command calibrate);

}  // namespace astro::commands
