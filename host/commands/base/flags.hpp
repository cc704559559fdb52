#pragma once

#include "host/console/command_line.hpp"

/// Options that mean the same in every command.
namespace astro::commands {

/// Adds --force to a command that uploads a calibration: see experiment::objections and agreed_to_load
/// (host/commands/shared/parameter_load.hpp).
void add_force(console::Command command, bool& force);

/// Adds --json.
void add_json_flag(console::Command command, bool& json);

}  // namespace astro::commands
