#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

/// `calibrate export`: a calibration for programs of others.
void add_calibrate_export(console::Command calibrate);

}  // namespace astro::commands
