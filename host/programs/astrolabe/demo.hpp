#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/console/command_line.hpp"

namespace astro::commands {

/// 'demo': the main job on a desk. A simulated robot whose wheels and wheelbase are off is calibrated over a real pseudo
/// terminal, driven again and reported, by the commands that a person would give.
///
/// Params  run  runs a command line of this program and returns its exit code
void add_demo(console::Command app, const std::function<int(const std::vector<std::string>&)>& run);

}  // namespace astro::commands
