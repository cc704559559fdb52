#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

/// `calibrate export`: a calibration for other programs.
void add_calibrate_export(console::Command calibrate);

}  // namespace astro::commands
