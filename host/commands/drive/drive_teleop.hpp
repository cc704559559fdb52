#pragma once

#include "host/console/command_line.hpp"

namespace astro::commands {

/// Adds `teleop` to `drive`: steering by keyboard.
void add_teleop(console::Command drive);

}  // namespace astro::commands
