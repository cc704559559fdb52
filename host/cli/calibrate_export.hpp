#pragma once

#include "host/cli/command_line.hpp"

namespace astro::cli {

/// `calibrate export`: a calibration for programs of others.
void add_calibrate_export(Command calibrate);

}  // namespace astro::cli
