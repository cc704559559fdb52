#pragma once

#include "host/console/command_line.hpp"

/// Options that mean the same in every command.
namespace astro::commands {

/// Adds --yes for a question that otherwise stands before what a command does; `answers` says which.
void add_yes(console::Command command, bool& yes, const char* answers);

/// Adds --json.
void add_json_flag(console::Command command, bool& json);

}  // namespace astro::commands
