#pragma once

#include "host/console/command_line.hpp"

/// Options that mean the same in every command.
namespace astro::commands {

/// Adds --force to a command that uploads a calibration: see experiment::objection.
void add_force(console::Command command, bool& force);

/// Adds --json.
void add_json_flag(console::Command command, bool& json);

}  // namespace astro::commands
