#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

/// 'selftest': whether the program does its work on this computer. Errors as host/commands/robot/commands.hpp; a failed check
/// ends with 1.
void add_selftest(console::Command app);

}  // namespace astro::commands
