#pragma once

#include "host/cli/command_line.hpp"

namespace astro::cli {

/// `calibrate check`: what calibrations are worth on recorded drives.
void add_calibrate_check(Command calibrate);

}  // namespace astro::cli
