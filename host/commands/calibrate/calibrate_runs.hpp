#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

/// `calibrate runs`: from recorded runs with ground truth.
void add_calibrate_runs(console::Command calibrate);

}  // namespace astro::commands
