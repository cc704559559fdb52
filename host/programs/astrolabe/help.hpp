#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/console/command_line.hpp"

namespace astro::commands {

/// 'help': the guides (host/guides), the table of the robot's parameters, and for the name of a command its --help. To be added
/// last, because it names all commands that `app` has.
///
/// Params  run  runs a command line of this program and returns its exit code
void add_help(console::Command app, const std::function<int(const std::vector<std::string>&)>& run);

}  // namespace astro::commands
