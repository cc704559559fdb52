#pragma once

#include "host/cli/command_line.hpp"

namespace astro::cli {

/// Adds `teleop` to `drive`: steering by keyboard.
void add_teleop(Command drive);

}  // namespace astro::cli
